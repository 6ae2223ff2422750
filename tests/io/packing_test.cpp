// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

#include "lidar_upsampling/io/output_file.h"
#include "lidar_upsampling/io/packed_reader.h"
#include "lidar_upsampling/io/packed_writer.h"
#include "lidar_upsampling/io/rawlog_stream.h"
#include "small_logs.h"
#include "test_folder.h"

namespace lidar_upsampling {
namespace {

constexpr std::size_t kMember = 1U << 20U;

/// Half of it repeats itself, half is noise, which cannot be packed.
Bytes some_bytes(std::size_t size, unsigned seed = 1) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(i < size / 2 ? i % 97 : random());
  return bytes;
}

void write_file(const std::string& path, Compression compression, const std::vector<Bytes>& parts) {
  OutputFile file(path);
  PackedWriter writer(file, compression);
  for (const Bytes& part : parts) writer.write(part);
  writer.finish();
  file.commit();
}

Bytes read_as_mrpt_does(const std::string& path, std::size_t size) {
  mrpt::io::CFileGZInputStream stream(path);
  Bytes bytes(size + 1);
  bytes.resize(stream.Read(bytes.data(), bytes.size()));
  return bytes;
}

class Packing : public ::testing::TestWithParam<Compression> {
 protected:
  TestFolder folder_;
};

TEST_P(Packing, what_is_written_is_read_again_by_us_and_by_mrpt) {
  const std::vector<Bytes> parts{some_bytes(10), some_bytes(3 * kMember), {},
                                 some_bytes(1),  some_bytes(kMember),     some_bytes(70000)};
  write_file(folder_ / "a", GetParam(), parts);
  const Bytes all = joined(parts);
  EXPECT_EQ(uncompressed(folder_ / "a"), all);
  if (GetParam().format == Compression::Format::zstd) return;  // that is another class's of MRPT
  EXPECT_EQ(read_as_mrpt_does(folder_ / "a", all.size()), all);
}

TEST_P(Packing, the_same_writes_make_the_same_file) {
  const std::vector<Bytes> parts{some_bytes(2 * kMember), some_bytes(5000)};
  write_file(folder_ / "a", GetParam(), parts);
  write_file(folder_ / "b", GetParam(), parts);
  EXPECT_EQ(file_bytes(folder_ / "a"), file_bytes(folder_ / "b"));
}

INSTANTIATE_TEST_SUITE_P(All, Packing,
                         ::testing::Values(Compression::none, Compression::fast, Compression::small,
                                           parse_compression("gzip:1"), parse_compression("gzip:9"),
                                           parse_compression("zstd:1"), parse_compression("zstd:3"),
                                           parse_compression("zstd:19")),
                         [](const auto& test) {
                           std::string name = to_text(test.param);
                           std::replace(name.begin(), name.end(), ':', '_');
                           return name;
                         });

/// Reads a file in pieces and writes them again, as `change` leaves them.
template <typename Change>
void copy_file(const std::string& from, const std::string& to, Compression compression,
               const std::vector<Bytes>& pieces, const Change& change) {
  PackedReader reader(from);
  OutputFile file(to);
  PackedWriter writer(file, compression);
  for (const Bytes& piece : pieces) {
    Bytes read(piece.size());
    EXPECT_EQ(reader.Read(read.data(), read.size()), read.size());
    EXPECT_EQ(reader.take_record(), piece);
    const PlaceInMembers place = reader.place_in_members();
    for (const Bytes& bytes : change(read)) writer.write(bytes, place);
  }
  writer.finish();
  file.commit();
}

std::vector<Bytes> as_it_is(const Bytes& piece) { return {piece}; }

/// Of pieces that somebody else has packed in members: the third and the fourth share one.
class CopiedMembers : public ::testing::Test {
 protected:
  CopiedMembers() { write_file(in_, parse_compression("gzip:9"), pieces_); }

  [[nodiscard]] bool holds_member_of(const std::string& path, const std::vector<Bytes>& pieces) {
    const std::string alone = folder_ / "alone";
    write_file(alone, parse_compression("gzip:9"), pieces);
    const Bytes all = file_bytes(path), member = file_bytes(alone);
    std::filesystem::remove(alone);
    return std::search(all.begin(), all.end(), member.begin(), member.end()) != all.end();
  }

  TestFolder folder_;
  const std::string in_ = folder_ / "in", out_ = folder_ / "out";
  const std::vector<Bytes> pieces_{some_bytes(2 * kMember, 1), some_bytes(400000, 2),
                                   some_bytes(10000, 3), some_bytes(500000, 4)};
};

TEST_F(CopiedMembers, stay_as_they_were_packed) {
  copy_file(in_, out_, Compression::fast, pieces_, as_it_is);
  EXPECT_EQ(file_bytes(out_), file_bytes(in_));
  write_file(folder_ / "anew", Compression::fast, pieces_);
  EXPECT_NE(file_bytes(folder_ / "anew"), file_bytes(in_));
}

TEST_F(CopiedMembers, are_packed_anew_where_a_piece_is_another_or_missing) {
  const auto changed = [](Bytes piece) {
    if (piece.size() == 10000) piece[5] ^= 1U;
    return std::vector<Bytes>{std::move(piece)};
  };
  const auto missing = [](const Bytes& piece) {
    return piece.size() == 10000 ? std::vector<Bytes>{} : std::vector<Bytes>{piece};
  };
  copy_file(in_, out_, Compression::fast, pieces_, changed);
  EXPECT_EQ(uncompressed(out_),
            joined({pieces_[0], pieces_[1], changed(pieces_[2])[0], pieces_[3]}));
  copy_file(in_, folder_ / "less", Compression::fast, pieces_, missing);
  EXPECT_EQ(uncompressed(folder_ / "less"), joined({pieces_[0], pieces_[1], pieces_[3]}));
  for (const std::string& path : {out_, folder_ / "less"}) {
    EXPECT_TRUE(holds_member_of(path, {pieces_[0]}) && holds_member_of(path, {pieces_[1]}));
    EXPECT_FALSE(holds_member_of(path, {pieces_[2], pieces_[3]}));
  }
}

TEST_F(CopiedMembers, need_no_bytes_beside_them_where_they_hold_one_object) {
  PackedReader reader(in_);
  OutputFile file(out_), plain_file(folder_ / "plain");
  PackedWriter writer(file, Compression::fast), plain(plain_file, Compression::none);
  for (const Bytes& piece : pieces_) {
    Bytes read(piece.size());
    EXPECT_EQ(reader.Read(read.data(), read.size()), read.size());
    const Bytes kept = reader.take_record(RecordBytes::left_to_member);
    const bool shares = &piece == &pieces_[2] || &piece == &pieces_[3];
    EXPECT_EQ(kept.capacity() > 0, shares);
    writer.write(kept, reader.place_in_members());
    if (shares) continue;
    EXPECT_THROW(plain.write(kept, reader.place_in_members()), std::logic_error);
  }
  writer.finish();
  file.commit();
  EXPECT_EQ(file_bytes(out_), file_bytes(in_));
}

TEST_F(CopiedMembers, are_refused_where_somebody_has_written_to_the_file_since) {
  PackedReader reader(in_);
  Bytes read(pieces_[0].size());
  ASSERT_EQ(reader.Read(read.data(), read.size()), read.size());
  static_cast<void>(reader.take_record());
  const auto member = reader.place_in_members().ended;
  ASSERT_TRUE(member);
  Bytes packed;
  member->read(packed);
  Bytes begin_of_file = file_bytes(in_);
  begin_of_file.resize(member->size);
  EXPECT_EQ(packed, begin_of_file);
  const auto end_of_member = static_cast<std::streamoff>(member->begin + member->size);
  std::fstream(in_, std::ios::in | std::ios::out).seekp(end_of_member - 6) << "xx";
  EXPECT_THROW(member->read(packed), std::runtime_error);
  std::filesystem::resize_file(in_, member->size / 2);
  EXPECT_THROW(member->read(packed), std::runtime_error);
}

TEST_F(CopiedMembers, hold_one_large_object_and_none_of_the_small_ones_before) {
  const std::vector<Bytes> pieces{some_bytes(300, 1), some_bytes(200, 2), some_bytes(kMember, 3),
                                  some_bytes(100, 4), some_bytes(kMember, 5)};
  write_file(folder_ / "mixed", Compression::fast, pieces);
  EXPECT_EQ(uncompressed(folder_ / "mixed"), joined(pieces));
  PackedReader reader(folder_ / "mixed");
  for (const Bytes& piece : pieces) {
    Bytes read(piece.size());
    EXPECT_EQ(reader.Read(read.data(), read.size()), read.size());
    const bool is_left = reader.take_record(RecordBytes::left_to_member).empty();
    EXPECT_EQ(is_left, piece.size() == kMember || &piece == &pieces[3]);
  }
}

TEST_F(CopiedMembers, let_others_come_between_pieces) {
  const Bytes other = some_bytes(70000, 5);
  copy_file(in_, out_, Compression::fast, pieces_, [&](const Bytes& piece) {
    return std::vector<Bytes>{piece, other};
  });
  EXPECT_EQ(uncompressed(out_),
            joined({pieces_[0], other, pieces_[1], other, pieces_[2], other, pieces_[3], other}));
  EXPECT_TRUE(holds_member_of(out_, {pieces_[0]}) && holds_member_of(out_, {pieces_[1]}));
}

TEST_F(CopiedMembers, are_packed_anew_where_the_packing_is_chosen) {
  for (const Compression compression :
       {Compression::none, Compression::small, parse_compression("zstd:3")}) {
    const std::string path = folder_ / to_text(compression), anew = path + "-anew";
    copy_file(in_, path, compression, pieces_, as_it_is);
    write_file(anew, compression, pieces_);
    EXPECT_EQ(file_bytes(path), file_bytes(anew)) << to_text(compression);
  }
}

TEST_F(CopiedMembers, need_no_members_in_a_log_that_is_one_stream) {
  const std::vector<Bytes> pieces{some_bytes(6 * kMember, 6), some_bytes(3 * kMember, 7),
                                  some_bytes(kMember, 8), some_bytes(100, 9)};
  write_file(in_ + "-one", parse_compression("gzip:1"), {joined(pieces)});
  copy_file(in_ + "-one", out_, Compression::fast, pieces, as_it_is);
  EXPECT_EQ(uncompressed(out_), joined(pieces));
}

/// Two members, and how long the first is.
struct TwoMembers {
  TwoMembers() {
    const TestFolder folder;
    write_file(folder / "first", Compression::fast, {first});
    write_file(folder / "second", Compression::fast, {second});
    size_of_first = file_bytes(folder / "first").size();
    packed = joined({file_bytes(folder / "first"), file_bytes(folder / "second")});
  }
  Bytes first = some_bytes(300000, 2), second = some_bytes(500000, 3), packed;
  std::size_t size_of_first = 0;
};

Bytes read_to_the_end(PackedReader& reader) {
  Bytes block(100000);
  while (reader.Read(block.data(), block.size()) > 0) {
  }
  return reader.take_record();
}

TEST(Unpacking, all_good_bytes_before_a_defect_are_given) {
  const TestFolder folder;
  TwoMembers file;
  file.packed[file.size_of_first + 200000] ^= 0x40U;
  write_bytes(folder / "a", file.packed);
  PackedReader reader(folder / "a");
  EXPECT_FALSE(reader.defect()) << "not before the good bytes are read";
  const Bytes got = read_to_the_end(reader);
  ASSERT_TRUE(reader.defect());
  EXPECT_NE(reader.defect()->find("damaged"), std::string::npos) << *reader.defect();
  ASSERT_GT(got.size(), file.first.size());
  EXPECT_TRUE(std::equal(file.first.begin(), file.first.end(), got.begin()));
}

TEST(Unpacking, a_cut_within_a_member_is_told_and_costs_only_what_is_behind_it) {
  const TestFolder folder;
  TwoMembers file;
  file.packed.resize(file.size_of_first + 100);
  write_bytes(folder / "a", file.packed);
  PackedReader reader(folder / "a");
  EXPECT_GE(read_to_the_end(reader).size(), file.first.size());
  ASSERT_TRUE(reader.defect());
  EXPECT_NE(reader.defect()->find("cut off"), std::string::npos) << *reader.defect();
}

TEST(Unpacking, what_follows_a_member_and_is_none_is_a_defect) {
  const TestFolder folder;
  const TwoMembers file;
  for (const Bytes& more : {Bytes(1, 0), Bytes(4096, 0), Bytes{0x1f}, Bytes{'e', 'n', 'd'}}) {
    write_bytes(folder / "a", joined({file.packed, more}));
    PackedReader reader(folder / "a");
    EXPECT_EQ(read_to_the_end(reader), joined({file.first, file.second})) << more.size();
    ASSERT_TRUE(reader.defect());
    EXPECT_NE(reader.defect()->find("damaged"), std::string::npos) << *reader.defect();
  }
}

TEST(Unpacking, a_member_whose_header_is_damaged_is_a_defect) {
  const TestFolder folder;
  for (const std::size_t at : {0U, 1U, 2U}) {
    TwoMembers file;
    file.packed[file.size_of_first + at] ^= 0x40U;
    write_bytes(folder / "a", file.packed);
    PackedReader reader(folder / "a");
    EXPECT_EQ(read_to_the_end(reader), file.first) << at;
    EXPECT_TRUE(reader.defect()) << at;
  }
}

TEST(Unpacking, of_a_small_file_all_but_what_the_defect_makes_unknown_is_given) {
  const TestFolder folder;
  const Bytes bytes = some_bytes(300000, 4);
  write_file(folder / "a", Compression::fast, {bytes});
  Bytes packed = file_bytes(folder / "a");
  packed[packed.size() - 6] ^= 0x01U;  // of the checksum
  write_bytes(folder / "a", packed);
  PackedReader reader(folder / "a");
  EXPECT_EQ(read_to_the_end(reader), bytes);
  EXPECT_TRUE(reader.defect());
}

TEST(Unpacking, tells_how_much_there_is_from_the_record_on) {
  const TestFolder folder;
  const TwoMembers file;
  write_bytes(folder / "a", file.packed);
  PackedReader reader(folder / "a");
  Bytes block(1000);
  const std::size_t all = file.first.size() + file.second.size();
  EXPECT_EQ(reader.bytes_from_record_on(), all);
  reader.Read(block.data(), block.size());
  EXPECT_EQ(reader.bytes_from_record_on(), all);
  static_cast<void>(reader.take_record());
  EXPECT_EQ(reader.bytes_from_record_on(), all - block.size());
}

TEST(Unpacking, a_reader_that_is_left_early_does_not_wait) {
  const TestFolder folder;
  write_file(folder / "a", Compression::fast, {some_bytes(20 * kMember)});
  PackedReader reader(folder / "a");
  std::uint8_t one = 0;
  EXPECT_EQ(reader.Read(&one, 1), 1U);
}

TEST(PackedWriter, keeps_what_is_written_at_once_in_one_member) {
  const TestFolder folder;
  const Bytes part = some_bytes(kMember + 1);
  write_file(folder / "one", Compression::fast, {part});
  write_file(folder / "two", Compression::fast, {part, part});
  const Bytes one = file_bytes(folder / "one");
  EXPECT_EQ(file_bytes(folder / "two"), joined({one, one}));
}

}  // namespace
}  // namespace lidar_upsampling
