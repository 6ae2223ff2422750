// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rawlog_stream.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/serialization/CArchive.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "lidar_upsampling/io/external_storage.h"
#include "lidar_upsampling/io/gzip_file.h"
#include "lidar_upsampling/text.h"

namespace fs = std::filesystem;

namespace lidar_upsampling {
namespace {

// Through --as-needed the linker drops MRPT's libraries, and with them their static registration.
void register_stock_classes() {
  static const bool done = [] {
    mrpt::obs::registerAllClasses_mrpt_obs();
    mrpt::maps::registerAllClasses_mrpt_maps();
    return true;
  }();
  static_cast<void>(done);
}

std::string explain(const std::exception& error) {
  std::string text = one_line(error);
  const auto from = text.find('\'');
  const auto to = text.find('\'', from + 1);
  if (text.find("not registered") == std::string::npos || to == std::string::npos) return text;
  return "class " + text.substr(from + 1, to - from - 1) +
         " is not known here: the log was made by a newer MRPT, or needs a plugin";
}

// MRPT stores colour pictures as JPEG unless told otherwise: what we write shall lose nothing.
class LosslessImages {
 public:
  LosslessImages() { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true); }
  ~LosslessImages() { mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(before_); }
  LosslessImages(const LosslessImages&) = delete;
  LosslessImages& operator=(const LosslessImages&) = delete;

 private:
  bool before_ = mrpt::img::CImage::DISABLE_JPEG_COMPRESSION();
};

}  // namespace

struct RawlogReader::Impl {
  explicit Impl(const std::string& path_)
      : path(path_), external_storage(external_storage_of(path_)), stream(path_) {}

  [[noreturn]] void fail(const std::string& reason) {
    failed = true;
    const std::string start =
        num_good == 0 ? path + " is no rawlog that can be read"
                      : path + ": broken after " + std::to_string(num_good) + " good objects";
    throw CorruptRawlog(start + ", at byte " + std::to_string(stream.getPosition()) +
                        " of the uncompressed data: " + reason);
  }

  void announce_external_storage() const {
    if (mrpt::io::getLazyLoadPathBase() == external_storage) return;
    mrpt::io::setLazyLoadPathBase(external_storage);  // of CImage too, since MRPT 2.3.3
  }

  std::string path;
  std::string external_storage;
  RecordingGzipReader stream;
  mrpt::serialization::CArchive::UniquePtr archive;
  std::size_t num_good = 0;
  bool failed = false;
};

RawlogReader::RawlogReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  register_stock_classes();
  impl_->archive = mrpt::serialization::archiveUniquePtrFrom<mrpt::io::CStream>(impl_->stream);
  impl_->announce_external_storage();
}
RawlogReader::~RawlogReader() = default;
RawlogReader::RawlogReader(RawlogReader&&) noexcept = default;

std::optional<RawlogEntry> RawlogReader::next() {
  Impl& log = *impl_;
  if (log.failed) return std::nullopt;
  log.announce_external_storage();
  if (log.stream.at_end()) {
    if (const auto defect = log.stream.defect()) log.fail(*defect);
    if (log.num_good == 0) log.fail("it is empty");
    return std::nullopt;
  }
  RawlogEntry entry;
  try {
    entry.object = log.archive->ReadObject();
  } catch (const std::exception& error) {
    if (const auto defect = log.stream.defect()) log.fail(*defect);
    if (log.stream.at_end()) log.fail("the file ends in the middle of an object");
    log.fail(explain(error));
  }
  if (!entry.object) log.fail("an empty object");
  entry.bytes = log.stream.take_record();
  ++log.num_good;
  return entry;
}

double RawlogReader::progress() const { return impl_->stream.progress(); }

RawlogEntry entry_of(const mrpt::serialization::CSerializable::Ptr& object) {
  const LosslessImages guard;
  RawlogEntry entry{object, {}};
  mrpt::serialization::ObjectToOctetVector(object.get(), entry.bytes);
  return entry;
}

struct RawlogWriter::Impl {
  Impl(std::string final_path, bool overwrite_, int compression)
      : path(std::move(final_path)),
        temporary_path(path + ".tmp-" + std::to_string(getpid())),
        overwrite(overwrite_),
        file(temporary_path, compression) {}

  std::string path;
  std::string temporary_path;
  bool overwrite;
  GzipWriter file;
  std::size_t num_written = 0;
  bool committed = false;
};

namespace {

void refuse_existing(const std::string& path, bool overwrite) {
  if (!fs::exists(path)) return;
  if (!fs::is_regular_file(path)) throw std::runtime_error(path + " is no regular file");
  if (!overwrite) throw std::runtime_error(path + " exists: pass --overwrite to replace it");
}

// Where the output really goes: through symbolic links, so that these are kept.
std::string checked_output_path(const std::string& path, bool overwrite) {
  const fs::path parent = fs::absolute(path).parent_path();
  if (path.empty() || !fs::is_directory(parent)) {
    throw std::runtime_error("cannot write '" + path + "': there is no folder " + parent.string());
  }
  refuse_existing(path, overwrite);
  return fs::exists(path) ? fs::canonical(path).string() : path;
}

}  // namespace

RawlogWriter::RawlogWriter(const std::string& path, bool overwrite, int compression)
    : impl_(std::make_unique<Impl>(checked_output_path(path, overwrite), overwrite, compression)) {}

RawlogWriter::~RawlogWriter() {
  if (!impl_->committed) std::remove(impl_->temporary_path.c_str());
}

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) {
  const LosslessImages guard;
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&object, bytes);
  impl_->file.write(bytes);
  ++impl_->num_written;
}

void RawlogWriter::write(const RawlogEntry& entry) {
  impl_->file.write(entry.bytes);
  ++impl_->num_written;
}

void RawlogWriter::commit() {
  impl_->file.close();
  refuse_existing(impl_->path, impl_->overwrite);
  fs::rename(impl_->temporary_path, impl_->path);
  impl_->committed = true;
}

std::size_t RawlogWriter::num_written() const { return impl_->num_written; }

}  // namespace lidar_upsampling
