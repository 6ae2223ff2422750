// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/io/rawlog_stream.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/lazy_load_path.h>
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/system/datetime.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "lidar_upsampling/io/next_object.h"
#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/io/packed_reader.h"
#include "lidar_upsampling/io/packed_writer.h"
#include "lidar_upsampling/io/reading_error.h"
#include "lidar_upsampling/io/reading_guard.h"

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

std::vector<std::uint8_t> bytes_of(const mrpt::serialization::CSerializable& object) {
  const LosslessImages guard;
  std::vector<std::uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&object, bytes);
  return bytes;
}

bool is_frame(const mrpt::serialization::CSerializable& object) {
  return dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object) != nullptr;
}

// What MRPT makes of an object of another class.
bool has_empty_observation(const mrpt::serialization::CSerializable& object) {
  const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object);
  return frame != nullptr &&
         std::any_of(frame->begin(), frame->end(), [](const auto& one) { return !one; });
}

}  // namespace

std::optional<Stamp> stamp_of(const RawlogEntry& entry) {
  const auto* observation = dynamic_cast<const mrpt::obs::CObservation*>(entry.object.get());
  const auto* const frame = dynamic_cast<const mrpt::obs::CSensoryFrame*>(entry.object.get());
  if (frame != nullptr && !frame->empty()) observation = frame->begin()->get();
  if (observation == nullptr || observation->timestamp == INVALID_TIMESTAMP) return {};
  return observation->timestamp;
}

std::string external_storage_of(const std::string& rawlog_path) {
  // Not CRawlog::detectImagesDirectory(): MRPT before 2.8.0 drops the file's stem there.
  const fs::path absolute = fs::absolute(rawlog_path);
  const fs::path stem = absolute.parent_path() / absolute.stem();
  for (const char* const ending : {"_Images", "_images", "_IMAGES"}) {
    std::error_code ignored;
    if (fs::is_directory(stem.string() + ending, ignored)) return stem.string() + ending;
  }
  return stem.string() + "_Images";
}

bool share_external_storage(const std::string& source_rawlog, const std::string& target_rawlog) {
  const fs::path source = external_storage_of(source_rawlog);
  std::error_code ignored;
  if (!fs::is_directory(source, ignored)) return true;
  const fs::path target = external_storage_of(target_rawlog);
  if (fs::equivalent(source, target, ignored)) return true;
  if (fs::is_symlink(target, ignored) && !fs::exists(target, ignored)) fs::remove(target, ignored);
  if (fs::exists(target, ignored)) return false;
  std::error_code error;
  fs::create_directory_symlink(fs::relative(source, fs::canonical(target.parent_path())), target,
                               error);
  return !error;
}

ExternalStorageGuard::ExternalStorageGuard() : before_(mrpt::io::getLazyLoadPathBase()) {}
ExternalStorageGuard::~ExternalStorageGuard() { mrpt::io::setLazyLoadPathBase(before_); }

RawlogReader::RawlogReader(const LogFile& log, RecordBytes bytes)
    : log_(log),
      bytes_(bytes),
      external_storage_(external_storage_of(log.path)),
      stream_(std::make_unique<PackedReader>(log.path)),
      archive_(mrpt::serialization::archiveUniquePtrFrom<mrpt::io::CStream>(*stream_)) {
  register_stock_classes();
}

RawlogReader::~RawlogReader() = default;
RawlogReader::RawlogReader(RawlogReader&&) noexcept = default;

void RawlogReader::announce_external_storage() const {
  if (mrpt::io::getLazyLoadPathBase() == external_storage_) return;
  mrpt::io::setLazyLoadPathBase(external_storage_);  // of CImage too, since MRPT 2.3.3
}

void RawlogReader::meet_damage(const std::string& reason) {
  std::string text = log_.path;
  text += num_good_ == 0 ? std::string(" is no rawlog that can be read")
                         : ": broken after " + std::to_string(num_good_) + " good objects";
  if (last_stamp_) text += ", the last one of " + mrpt::system::dateTimeToString(*last_stamp_);
  text += ", at byte " + std::to_string(stream_->getPosition()) +
          " of the uncompressed data: " + reason;
  if (num_good_ > 0 && log_.accepts_damage) {
    left_out_.begin(text);
    return;
  }
  is_over_ = true;
  throw CorruptRawlog(num_good_ == 0 ? text : text + "; --accept-truncated leaves out the damage");
}

// Whether there is a next part of the file behind a damaged one.
bool RawlogReader::goes_on_behind_end() {
  const auto defect = stream_->defect();
  if (defect) meet_damage(*defect);
  if (!defect && num_good_ == 0) meet_damage("it is empty");
  const auto not_unpacked = defect ? stream_->resume() : std::nullopt;
  if (!not_unpacked) return false;
  left_out_.add_packed(*not_unpacked);
  find_next(0);
  return true;
}

void RawlogReader::find_next(std::uint64_t least) {
  const auto begins = [this](const std::uint8_t* bytes, std::size_t size) {
    return begins_object(bytes, size, has_frames_);
  };
  left_out_.add(stream_->skip_to(begins, least));
}

void RawlogReader::note_good(const RawlogEntry& entry) {
  ++num_good_;
  has_frames_ = has_frames_ || is_frame(*entry.object) ||
                dynamic_cast<const mrpt::obs::CActionCollection*>(entry.object.get()) != nullptr;
  const auto stamp = stamp_of(entry);
  if (!stamp) return;
  last_stamp_ = stamp;
  left_out_.goes_on(*stamp);
}

std::nullopt_t RawlogReader::end() {
  is_over_ = true;
  told_damage_ = left_out_.text();
  return std::nullopt;
}

// @return why there is none.
std::optional<std::string> RawlogReader::read_object(RawlogEntry& entry) {
  try {
    const ReadingGuard guard([this] { return stream_->bytes_from_record_on(); });
    entry.object = archive_->ReadObject();
    if (!entry.object) return "an empty object";
    if (has_empty_observation(*entry.object))
      return "a frame holds something else than observations";
    return {};
  } catch (const std::exception& error) {
    if (auto defect = stream_->defect()) return defect;
    if (stream_->at_end()) return "the file ends in the middle of an object";
    return why_not_read(error);
  }
}

std::optional<RawlogEntry> RawlogReader::next() {
  if (is_over_) return std::nullopt;
  announce_external_storage();
  for (;;) {
    if (stream_->at_end()) {
      if (!goes_on_behind_end()) return end();
      continue;
    }
    RawlogEntry entry;
    if (const auto reason = read_object(entry)) {
      meet_damage(*reason);
      find_next(std::max<std::uint64_t>(1, stream_->doubtful_from_record_on()));
      continue;
    }
    const bool splits = bytes_ == RecordBytes::left_to_member && is_frame(*entry.object);
    entry.bytes = stream_->take_record(splits ? RecordBytes::kept : bytes_);
    entry.packed = stream_->place_in_members();
    note_good(entry);
    return entry;
  }
}

double RawlogReader::progress() const { return stream_->progress(); }

RawlogEntry entry_of(const mrpt::serialization::CSerializable::Ptr& object) {
  return {object, bytes_of(*object)};
}

RawlogWriter::RawlogWriter(const std::string& path, bool overwrite, Compression compression)
    : own_(std::make_unique<OutputFile>(path, OutputOptions{overwrite})),
      packed_(std::make_unique<PackedWriter>(*own_, compression)) {}

RawlogWriter::RawlogWriter(OutputFile& file, Compression compression)
    : packed_(std::make_unique<PackedWriter>(file, compression)) {}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) {
  write(RawlogEntry{nullptr, bytes_of(object)});
}

void RawlogWriter::write(const RawlogEntry& entry) {
  packed_->write(entry.bytes, entry.packed);
  ++num_written_;
}

void RawlogWriter::finish() { packed_->finish(); }

void RawlogWriter::commit() {
  finish();
  own_->commit();
}

}  // namespace lidar_upsampling
