// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rebinding.h"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>

namespace lidar_upsampling {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kCalled = R_X86_64_JUMP_SLOT, kAddressed = R_X86_64_GLOB_DAT;
constexpr bool kIsKnown = true;
#elif defined(__aarch64__)
constexpr std::uint32_t kCalled = R_AARCH64_JUMP_SLOT, kAddressed = R_AARCH64_GLOB_DAT;
constexpr bool kIsKnown = true;
#else
constexpr std::uint32_t kCalled = 0, kAddressed = 0;
constexpr bool kIsKnown = false;
#endif

// Where the loader has put an object, and what it was told to fill in there.
class LoadedObject {
 public:
  explicit LoadedObject(const dl_phdr_info& info) : base_(info.dlpi_addr) {
    for (int i = 0; i < info.dlpi_phnum; ++i) {
      const ElfW(Phdr)& segment = info.dlpi_phdr[i];
      const std::uintptr_t begin = base_ + segment.p_vaddr;
      if (segment.p_type == PT_DYNAMIC) read(reinterpret_cast<const ElfW(Dyn)*>(begin));
      if (segment.p_type != PT_GNU_RELRO) continue;
      protected_begin_ = begin;
      protected_end_ = begin + segment.p_memsz;
    }
  }

  void apply(const std::vector<Rebinding>& changes) const {
    if (symbols_ == nullptr || names_ == nullptr) return;
    for (const Table& table : {calls_, addresses_})
      for (std::size_t i = table.first; i < table.size / sizeof(ElfW(Rela)); ++i) {
        const ElfW(Rela)& entry = table.begin[i];
        const std::uint32_t type = ELF64_R_TYPE(entry.r_info);
        if (type != kCalled && type != kAddressed) continue;
        const char* const name = names_ + symbols_[ELF64_R_SYM(entry.r_info)].st_name;
        for (const Rebinding& change : changes)
          if (std::strcmp(name, change.symbol) == 0)
            write(reinterpret_cast<void**>(base_ + entry.r_offset), change.replacement);
      }
  }

 private:
  struct Table {
    const ElfW(Rela) * begin = nullptr;
    std::size_t size = 0;   // bytes
    std::size_t first = 0;  // entry that has a symbol
  };

  void read(const ElfW(Dyn) * item) {
    for (; item->d_tag != DT_NULL; ++item) {
      const auto address = item->d_un.d_ptr;  // by now absolute
      if (item->d_tag == DT_SYMTAB) symbols_ = reinterpret_cast<const ElfW(Sym)*>(address);
      if (item->d_tag == DT_STRTAB) names_ = reinterpret_cast<const char*>(address);
      if (item->d_tag == DT_JMPREL) calls_.begin = reinterpret_cast<const ElfW(Rela)*>(address);
      if (item->d_tag == DT_PLTRELSZ) calls_.size = item->d_un.d_val;
      if (item->d_tag == DT_RELA) addresses_.begin = reinterpret_cast<const ElfW(Rela)*>(address);
      if (item->d_tag == DT_RELASZ) addresses_.size = item->d_un.d_val;
      if (item->d_tag == DT_RELACOUNT) addresses_.first = item->d_un.d_val;
    }
  }

  void write(void** slot, void* value) const {
    const auto address = reinterpret_cast<std::uintptr_t>(slot);
    const bool is_protected = address >= protected_begin_ && address < protected_end_;
    const auto page_size = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    auto* const page = reinterpret_cast<void*>(address / page_size * page_size);
    if (is_protected && mprotect(page, page_size, PROT_READ | PROT_WRITE) != 0) return;
    __atomic_store_n(slot, value, __ATOMIC_RELEASE);
    if (is_protected) mprotect(page, page_size, PROT_READ);
  }

  std::uintptr_t base_ = 0, protected_begin_ = 0, protected_end_ = 0;
  const ElfW(Sym) * symbols_ = nullptr;
  const char* names_ = nullptr;
  Table calls_, addresses_;
};

using Changes = std::vector<Rebinding>;

int apply_to(dl_phdr_info* info, std::size_t, void* changes) {
  constexpr int kGoOn = 0;
  // The kernel's own has a table that is not relocated, and calls nothing.
  const bool is_kernels = std::strstr(info->dlpi_name, "linux-vdso") != nullptr;
  if (!is_kernels) LoadedObject(*info).apply(*static_cast<const Changes*>(changes));
  return kGoOn;
}

}  // namespace

void* function_named(const char* symbol) {
  void* const function = dlsym(RTLD_DEFAULT, symbol);
  return function != nullptr ? function : dlsym(RTLD_NEXT, symbol);  // a module's own libraries
}

void rebind(const std::vector<Rebinding>& changes) {
  if (!kIsKnown) return;
  Changes copy(changes);  // C's interface knows no const
  dl_iterate_phdr(apply_to, &copy);
}

}  // namespace lidar_upsampling
