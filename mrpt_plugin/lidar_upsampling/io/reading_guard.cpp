// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/reading_guard.h"

#include <mrpt/obs/CAction.h>
#include <mrpt/poses/CPosePDF.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

// jpeglib.h needs it before.
#include <cstdio>

#include <jpeglib.h>

#include <cstdlib>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lidar_upsampling/io/rebinding.h"

namespace lidar_upsampling {
namespace {

constexpr std::uint64_t kAlwaysFine = 1U << 24U;
// Of small pieces: lists keep some more than what is stored, and what is given back counts, too.
constexpr std::uint64_t kPiecesAlwaysFine = 1U << 26U, kPiecesPerByte = 16;

thread_local ReadingGuard* innermost = nullptr;

class TooMuch : public std::bad_alloc {
 public:
  explicit TooMuch(std::uint64_t size)
      : text_("it asks for " + std::to_string(size) + " bytes, more than the file can fill") {}
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

// Destructors of MRPT's ask for memory, too, and an exception out of them would be the end.
bool may_refuse() { return innermost != nullptr && std::uncaught_exceptions() == 0; }

void refuse_excess(std::uint64_t size, std::uint64_t per_byte) {
  if (size <= kAlwaysFine || !may_refuse()) return;
  ReadingGuard& guard = *innermost;
  const ReadingGuard::Pause pause;  // it asks for memory itself
  guard.check(size, per_byte);
}

void refuse_excess(std::uint64_t size) {
  if (innermost == nullptr) return;
  refuse_excess(size, 1);
  ReadingGuard& guard = *innermost;
  if (guard.count(size) <= kPiecesAlwaysFine || !may_refuse()) return;
  const ReadingGuard::Pause pause;
  guard.check_all();
}

void* aligned_malloc(std::size_t size, std::size_t alignment) {
  refuse_excess(size);
  if (size > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()))
    throw std::bad_alloc();
  void* const memory =
      std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* (*system_new)(std::size_t) = nullptr;

void* checked_new(std::size_t size) {
  refuse_excess(size);
  return system_new(size);
}

jpeg_error_mgr* (*system_jpeg_error)(jpeg_error_mgr*) = nullptr;

[[noreturn]] void throw_jpeg_error(j_common_ptr picture) {
  char text[JMSG_LENGTH_MAX];
  picture->err->format_message(picture, text);
  if (picture->mem != nullptr) picture->mem->self_destruct(picture);
  throw std::runtime_error(std::string(kBrokenJpeg) + text);
}

// It is told of the frame's size, too, when that has been read.
void hear_jpeg_message(j_common_ptr picture, int level) {
  constexpr std::uint64_t kMostPacked = 200;  // of one colour all over, a byte is some 170
  if (level < 0) ++picture->err->num_warnings;
  if (picture->is_decompressor == FALSE) return;
  const auto* const reading = reinterpret_cast<j_decompress_ptr>(picture);
  refuse_excess(std::uint64_t{reading->image_width} * reading->image_height *
                    static_cast<std::uint64_t>(reading->num_components),
                kMostPacked);
}

void say_nothing(j_common_ptr) {}

jpeg_error_mgr* throwing_jpeg_error(jpeg_error_mgr* manager) {
  system_jpeg_error(manager);
  manager->error_exit = throw_jpeg_error;
  manager->emit_message = hear_jpeg_message;
  manager->output_message = say_nothing;
  return manager;
}

// Of libpng, whose header not every system has that has OpenCV.
using PngMessage = void(void* png, const char* text);
using MakePng = void*(const char* version, void* told, PngMessage* error, PngMessage* warning);
MakePng* system_make_png = nullptr;
void (*png_longjmp)(void* png, int value) = nullptr;

void leave_png(void* png, const char*) { png_longjmp(png, 1); }

void hear_png_warning(void*, const char*) {}

void* make_quiet_png(const char* version, void* told, PngMessage* error, PngMessage* warning) {
  return system_make_png(version, told, error != nullptr ? error : leave_png,
                         warning != nullptr ? warning : hear_png_warning);
}

std::shared_ptr<mrpt::rtti::CObject> create_object(const mrpt::rtti::TRuntimeClassId* of_class) {
  if (of_class->ptrCreateObject) return of_class->ptrCreateObject();
  throw std::runtime_error(std::string("there are no objects of class ") + of_class->className);
}

// MRPT copies these without a look at whether there is one.
template <typename Class>
class NeverNull {
 public:
  static void add_to(std::vector<Rebinding>& changes, const char* symbol);

 private:
  using Read = std::shared_ptr<Class>(mrpt::serialization::CArchive*);

  static std::shared_ptr<Class> read(mrpt::serialization::CArchive* from) {
    auto object = system_read(from);
    if (!object) throw std::runtime_error("an empty object, or one of another class, within one");
    return object;
  }

  static inline Read* system_read = nullptr;
};

// A function that is not there needs no other.
template <typename Function>
void add_change(std::vector<Rebinding>& changes, const char* symbol, Function* replacement,
                Function*& original) {
  original = reinterpret_cast<Function*>(function_named(symbol));
  if (original != nullptr) changes.push_back({symbol, reinterpret_cast<void*>(replacement)});
}

template <typename Class>
void NeverNull<Class>::add_to(std::vector<Rebinding>& changes, const char* symbol) {
  add_change(changes, symbol, read, system_read);
}

void rebind_all() {
  std::vector<Rebinding> changes{
      {"_ZN4mrpt14aligned_mallocEmm", reinterpret_cast<void*>(aligned_malloc)},
      {"_ZNK4mrpt4rtti15TRuntimeClassId12createObjectEv", reinterpret_cast<void*>(create_object)}};
  NeverNull<mrpt::obs::CAction>::add_to(
      changes, "_ZN4mrpt13serialization8CArchive10ReadObjectINS_3obs7CActionEEENT_3PtrEv");
  NeverNull<mrpt::poses::CPosePDF>::add_to(
      changes, "_ZN4mrpt13serialization8CArchive10ReadObjectINS_5poses8CPosePDFEEENT_3PtrEv");
  add_change(changes, "_Znwm", checked_new, system_new);
  add_change(changes, "jpeg_std_error", throwing_jpeg_error, system_jpeg_error);
  png_longjmp = reinterpret_cast<decltype(png_longjmp)>(function_named("png_longjmp"));
  if (png_longjmp != nullptr)
    add_change(changes, "png_create_read_struct", make_quiet_png, system_make_png);
  rebind(changes);  // only now: others may call the replacements at once
}

}  // namespace

ReadingGuard::Pause::Pause() : paused_(std::exchange(innermost, nullptr)) {}

ReadingGuard::Pause::~Pause() { innermost = paused_; }

ReadingGuard::ReadingGuard(BytesLeft bytes_left)
    : bytes_left_(std::move(bytes_left)), outer_(innermost) {
  static const bool done = [] {
    rebind_all();
    return true;
  }();
  static_cast<void>(done);
  innermost = this;
}

ReadingGuard::~ReadingGuard() { innermost = outer_; }

std::uint64_t ReadingGuard::left() {
  constexpr std::uint64_t kMostUnknown = 1U << 30U;
  if (!left_) {
    const std::optional<std::uint64_t> left = bytes_left_();
    left_ = left ? *left : kMostUnknown;
  }
  return *left_;
}

void ReadingGuard::check(std::uint64_t size, std::uint64_t per_byte) {
  if (size > kAlwaysFine + left() * per_byte) throw TooMuch(size);
}

void ReadingGuard::check_all() {
  if (count_ <= kPiecesAlwaysFine + left() * kPiecesPerByte) return;
  throw TooMuch(std::exchange(count_, 0));  // who catches it needs some, too
}

}  // namespace lidar_upsampling
