// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/unpacker.h"

#include <isa-l/igzip_lib.h>
#include <unistd.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lidar_upsampling/io/gzip_members.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kInput = 1U << 18U;
const std::vector<std::uint8_t> kGzip{0x1f, 0x8b}, kZstd{0x28, 0xb5, 0x2f, 0xfd};

std::string reason_of(int code) {
  switch (code) {
    case ISAL_INCORRECT_CHECKSUM:
      return "its checksum is another one";
    case ISAL_INVALID_WRAPPER:
    case ISAL_UNSUPPORTED_METHOD:
      return "its header is none that gzip writes";
    default:
      return "its codes make no sense";
  }
}

std::string reason_of_zstd(std::size_t code) {
  switch (ZSTD_getErrorCode(code)) {
    case ZSTD_error_checksum_wrong:
      return "its checksum is another one";
    case ZSTD_error_prefix_unknown:
    case ZSTD_error_version_unsupported:
    case ZSTD_error_frameParameter_unsupported:
      return "its header is none that zstd writes";
    case ZSTD_error_frameParameter_windowTooLarge:
    case ZSTD_error_memory_allocation:
      return "it asks for more memory than any log's needs";
    default:
      return "its codes make no sense";
  }
}

}  // namespace

Unpacker::Unpacker(const std::string& path)
    : file_(std::make_shared<const InputFile>(path)), input_(kInput) {
  if (starts_with(kGzip)) {
    kind_ = Kind::gzip;
    state_ = std::make_unique<inflate_state>();
    isal_inflate_init(state_.get());
    state_->crc_flag = ISAL_GZIP;
  } else if (starts_with(kZstd)) {
    kind_ = Kind::zstd;
    zstd_.reset(ZSTD_createDCtx());
    if (!zstd_) throw std::bad_alloc();
  }
}

void Unpacker::Free::operator()(ZSTD_DCtx_s* state) const { ZSTD_freeDCtx(state); }

Unpacker::~Unpacker() = default;

std::uint64_t Unpacker::file_position() const { return num_read_ - size_; }

std::size_t Unpacker::unpack(std::vector<std::uint8_t>& block) {
  if (is_at_end_) return 0;
  const std::size_t done = kind_ == Kind::gzip   ? inflate(block)
                           : kind_ == Kind::zstd ? unpack_zstd(block)
                                                 : copy(block);
  unpacked_size_ += done;
  return done;
}

// What is left moves to the front, so that a header's first bytes are always seen together.
bool Unpacker::refill() {
  std::copy_n(input_.begin() + static_cast<std::ptrdiff_t>(begin_), size_, input_.begin());
  begin_ = 0;
  while (size_ < input_.size()) {
    const ssize_t got = read(file_->handle(), input_.data() + size_, input_.size() - size_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) defect_ = "read error: " + std::generic_category().message(errno);
    if (got <= 0) break;
    size_ += static_cast<std::size_t>(got);
    num_read_ += static_cast<std::size_t>(got);
  }
  return size_ > 0;
}

bool Unpacker::starts_with(const std::vector<std::uint8_t>& magic) {
  if (size_ < magic.size()) refill();
  return size_ >= magic.size() && std::equal(magic.begin(), magic.end(), input_.data() + begin_);
}

std::size_t Unpacker::end(std::size_t done, std::optional<std::string> defect) {
  is_at_end_ = true;
  if (!defect_) defect_ = std::move(defect);
  return done;
}

std::size_t Unpacker::copy(std::vector<std::uint8_t>& block) {
  std::size_t done = 0;
  while (done < block.size()) {
    if (size_ == 0 && !refill()) return end(done, {});
    const std::size_t step = std::min(size_, block.size() - done);
    std::copy_n(input_.data() + begin_, step, block.data() + done);
    begin_ += step;
    size_ -= step;
    done += step;
  }
  return done;
}

void Unpacker::end_member(std::uint64_t unpacked_position) {
  const std::uint64_t end = file_position();
  const std::uint64_t unpacked_size = unpacked_position - sound_size_;
  MemberEnd ended{unpacked_position, nullptr};
  if (is_kept_ && file_->is_regular() && unpacked_size <= PackedMember::kLargest)
    ended.member = std::make_shared<const PackedMember>(
        PackedMember{file_, member_begin_, end - member_begin_, unpacked_size, state_->crc});
  if (keeps_members_) ends_.push_back(std::move(ended));
  is_kept_ = keeps_members_;
  member_begin_ = end;
  sound_size_ = unpacked_position;
}

std::size_t Unpacker::inflate(std::vector<std::uint8_t>& block) {
  inflate_state& state = *state_;
  std::size_t done = 0;
  while (done < block.size()) {
    const bool has_input = size_ > 0 || refill();  // none: what is unpacked may still wait inside
    const std::size_t before = done;
    state.next_in = input_.data() + begin_;
    state.avail_in = static_cast<std::uint32_t>(size_);
    state.next_out = block.data() + done;
    state.avail_out = static_cast<std::uint32_t>(block.size() - done);
    const int code = isal_inflate(&state);
    done = block.size() - state.avail_out;
    begin_ += size_ - state.avail_in;
    size_ = state.avail_in;
    if (code != ISAL_DECOMP_OK) return end(done, "the gzip stream is damaged: " + reason_of(code));
    if (state.block_state != ISAL_BLOCK_FINISH) {
      if (!has_input && done == before) return end(done, "the gzip stream is cut off");
      continue;
    }
    end_member(unpacked_size_ + done);
    if (!starts_with(kGzip))
      return size_ == 0 ? end(done, {})
                        : end(done, "the gzip stream is damaged: what follows it is none");
    isal_inflate_reset(&state);
    state.crc_flag = ISAL_GZIP;
  }
  return done;
}

std::size_t Unpacker::unpack_zstd(std::vector<std::uint8_t>& block) {
  ZSTD_outBuffer out{block.data(), block.size(), 0};
  while (out.pos < out.size) {
    const bool has_input = size_ > 0 || refill();  // none: what is unpacked may still wait inside
    if (!has_input && !in_frame_) return end(out.pos, {});
    const std::size_t before = out.pos;
    ZSTD_inBuffer in{input_.data() + begin_, size_, 0};
    const std::size_t code = ZSTD_decompressStream(zstd_.get(), &out, &in);
    begin_ += in.pos;
    size_ -= in.pos;
    if (ZSTD_isError(code) != 0)
      return end(out.pos, "the zstd stream is damaged: " + reason_of_zstd(code));
    in_frame_ = code != 0;
    if (!has_input && in_frame_ && out.pos == before)
      return end(out.pos, "the zstd stream is cut off");
  }
  return out.pos;
}

std::uint64_t unpacked_size_of(const std::string& path) {
  Unpacker unpacker(path);
  std::vector<std::uint8_t> block(1U << 20U);
  std::uint64_t size = 0;
  do {
    while (const std::size_t step = unpacker.unpack(block)) size += step;
  } while (unpacker.resume());
  return size;
}

std::vector<UnpackedPart> doubtful_parts_of(const std::string& path) {
  Unpacker unpacker(path);
  std::vector<std::uint8_t> block(1U << 20U);
  std::vector<UnpackedPart> parts;
  do {
    while (unpacker.unpack(block) > 0) continue;
    if (unpacker.is_packed() && unpacker.defect())
      parts.push_back({unpacker.sound_size(), unpacker.unpacked_size()});
  } while (unpacker.resume());
  return parts;
}

std::optional<std::uint64_t> Unpacker::resume() {
  if (kind_ != Kind::gzip || !defect_) return {};
  const std::uint64_t position = file_position();
  const bool is_between = position == member_begin_;
  const auto next =
      next_gzip_member(file_->handle(), member_begin_ + (is_between ? 0 : 1), is_between);
  if (!next || lseek(file_->handle(), static_cast<off_t>(next->from), SEEK_SET) < 0) return {};
  num_read_ = member_begin_ = next->from;
  is_kept_ = keeps_members_ && next->has_header;
  sound_size_ = unpacked_size_;
  begin_ = size_ = 0;
  is_at_end_ = false;
  defect_.reset();
  isal_inflate_reset(state_.get());
  state_->crc_flag = next->has_header ? ISAL_GZIP : ISAL_GZIP_NO_HDR_VER;
  return next->from > position ? next->from - position : 0;
}

}  // namespace lidar_upsampling
