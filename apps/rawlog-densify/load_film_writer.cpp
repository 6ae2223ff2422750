// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <dlfcn.h>

#include <stdexcept>

#include "film_writer.h"

namespace lidar_upsampling {

std::unique_ptr<FilmWriter> load_film_writer() {
  void* const library = dlopen("lidar_upsampling_film.so", RTLD_NOW);
  void* const make = library == nullptr ? nullptr : dlsym(library, "lidar_upsampling_film_writer");
  if (make == nullptr)
    throw std::runtime_error(std::string("no film can be made, as its library cannot be loaded: ") +
                             dlerror());
  return std::unique_ptr<FilmWriter>(reinterpret_cast<FilmWriter* (*)()>(make)());
}

}  // namespace lidar_upsampling
