#include "canopeer/sensing/cloud_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/base/rng.h"
#include "canopeer/sensing/files/lzf.h"

namespace canopeer {
namespace {

// Most significant byte first.
template <typename T>
void append_big(std::string& bytes, T value) {
  std::string little;
  append_number(little, value);
  bytes.append(little.rbegin(), little.rend());
}

std::string message(const Expected<CloudFile>& file) {
  return file.has_value() ? "no error" : file.error().message;
}

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << "\"" << part << "\" in: " << whole;
}

TEST(PlyReader, ReadsBackWhatIsWritten) {
  PointCloud cloud;
  cloud.points = {{1.5F, -2.0F, 0.25F}, {4.0F, 5.0F, 6.0F}};
  cloud.normals = {{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
  cloud.colors = {{204, 41, 9}, {1, 2, 3}};
  const auto path = std::filesystem::path(testing::TempDir()) / "canopeer_read_back.ply";
  ASSERT_TRUE(write_ply(path, cloud));
  const auto file = read_cloud(path);
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->cloud.points == cloud.points);
  EXPECT_TRUE(file->cloud.normals == cloud.normals);
  EXPECT_TRUE(file->cloud.colors == cloud.colors);
  EXPECT_TRUE(file->roi_confidence.empty());
  EXPECT_FALSE(file->T_world_points);
}

TEST(PlyReader, ReadsTextWithOtherElementsListsAndColumns) {
  const std::string text =
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement camera 1\r\nproperty list uchar "
      "int ids\r\nproperty float f\r\nelement vertex 2\r\nproperty double x\r\nproperty float "
      "quality\r\nproperty float y\r\nproperty float z\r\nproperty uchar roi\r\nelement face "
      "1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "3 7 8 9 1.5\r\n1 9 2 3 1\r\n+4 9 nan 6e0 0\r\n3 0 1 0\r\n";
  const auto file = parse_ply(text, "hand.ply");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->cloud.points.size(), 2U);
  EXPECT_EQ(file->cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(file->cloud.points[1].x(), 4.0F);
  EXPECT_TRUE(std::isnan(file->cloud.points[1].y()));
  EXPECT_EQ(file->roi_confidence, (std::vector<float>{1.0F, 0.0F}));
}

TEST(PlyReader, ReadsBothByteOrders) {
  const std::string header =
      "element vertex 1\nproperty double x\nproperty float y\nproperty short z\nproperty list "
      "uchar ushort more\nproperty float red\nproperty float green\nproperty float "
      "blue\nend_header\n";
  std::string little = "ply\nformat binary_little_endian 1.0\n" + header;
  std::string big = "ply\nformat binary_big_endian 1.0\n" + header;
  const auto both = [&](auto value) {
    append_number(little, value);
    append_big(big, value);
  };
  both(1.25);
  both(-2.5F);
  both(std::int16_t{-7});
  both(std::uint8_t{2});
  both(std::uint16_t{77});
  both(std::uint16_t{78});
  for (const float channel : {1.0F, 0.5F, 0.0F}) both(channel);
  for (const std::string& bytes : {little, big}) {
    const auto file = parse_ply(bytes, "a.ply");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->cloud.points.at(0), Eigen::Vector3f(1.25F, -2.5F, -7.0F));
    EXPECT_TRUE(file->cloud.colors.at(0) == (Rgb{255, 128, 0}));
  }
}

TEST(PlyReader, ErrorsSayWhereAndWhatWasExpected) {
  const auto error = [](const std::string& text) { return message(parse_ply(text, "a.ply")); };
  const std::string xyz =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  expect_in("not a PLY file", error("hello"));
  expect_in("end_header", error("ply\nformat ascii 1.0\n"));
  expect_in("a.ply:2: expected \"format ascii", error("ply\nformat text 1.0\n" + xyz));
  expect_in("a.ply:3: expected \"element NAME COUNT\"",
            error("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"));
  expect_in("a.ply:4: expected \"property TYPE NAME\"",
            error("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"));
  expect_in("no properties x, y and z",
            error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"));
  expect_in("no element \"vertex\"", error("ply\nformat ascii 1.0\nend_header\n"));
  expect_in("a.ply:8: expected a line of 3 numbers",
            error("ply\nformat ascii 1.0\n" + xyz + "1 2 x\n"));
  expect_in("vertex 2 of 2", error("ply\nformat ascii 1.0\n" + xyz + "1 2 3\n"));
  expect_in("vertex 1 of 2", error("ply\nformat binary_little_endian 1.0\n" + xyz + "12345678901"));
  expect_in("cloud.txt", message(read_cloud("cloud.txt")));
  expect_in("/nowhere/a.ply", message(read_cloud("/nowhere/a.ply")));
}

TEST(PlyReader, AClaimOfManyPointsTakesNoMemory) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement other 9000000000000000000\nproperty list "
      "uchar int ids\nelement vertex 9000000000000000000\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  expect_in("cut off", message(parse_ply(header + std::string(64, '\0'), "a.ply")));
}

constexpr char kPcdHeader[] =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb _ roi\nSIZE 4 4 4 4 1 4\nTYPE F F F F U F\n"
    "COUNT 1 1 1 1 3 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 1 2 3 0 0 0 1\nPOINTS 2\nDATA ";

// Field after field or point after point.
std::string pcd_values(bool by_field) {
  const float xyz[2][3] = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
  std::string bytes;
  const auto field = [&](int point, int f) {
    if (f < 3) append_number(bytes, xyz[point][f]);
    if (f == 3) append_number(bytes, std::uint32_t{0xFF0A141E});  // opaque: no number as a float
    if (f == 4) bytes += "pad";
    if (f == 5) append_number(bytes, point == 0 ? 0.25F : 0.75F);
  };
  for (int i = 0; i < 12; ++i) by_field ? field(i % 2, i / 2) : field(i / 6, i % 6);
  return bytes;
}

// Everything as literals: a legal, if poor, compression.
std::string lzf_literals(const std::string& content) {
  std::string out;
  for (std::size_t at = 0; at < content.size(); at += 32) {
    const std::string run = content.substr(at, 32);
    out.push_back(static_cast<char>(run.size() - 1));
    out += run;
  }
  return out;
}

std::string pcd_compressed(const std::string& content) {
  const std::string packed = lzf_literals(content);
  std::string bytes = kPcdHeader + std::string("binary_compressed\n");
  append_number(bytes, static_cast<std::uint32_t>(packed.size()));
  append_number(bytes, static_cast<std::uint32_t>(content.size()));
  return bytes + packed;
}

TEST(PcdReader, ReadsTextBinaryAndCompressed) {
  const std::string text =
      std::string(kPcdHeader) + "ascii\n1 2 3 9.2e-40 7 7 7 0.25\n4 5 6 0 7 7 7 0.75\n";
  for (const std::string& bytes : {text, kPcdHeader + std::string("binary\n") + pcd_values(false),
                                   pcd_compressed(pcd_values(true))}) {
    const auto file = parse_pcd(bytes, "a.pcd");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->cloud.points.size(), 2U);
    EXPECT_EQ(file->cloud.points[1], Eigen::Vector3f(4, 5, 6));
    EXPECT_EQ(file->roi_confidence, (std::vector<float>{0.25F, 0.75F}));
    ASSERT_EQ(file->cloud.colors.size(), 2U);
    if (&bytes != &text && bytes != text) {
      EXPECT_TRUE(file->cloud.colors[0] == (Rgb{10, 20, 30}));
    }
    ASSERT_TRUE(file->T_world_points);
    // Half a turn about z, then the offset.
    EXPECT_TRUE((*file->T_world_points * Vec3(1, 0, 0)).isApprox(Vec3(0, 2, 3)));
  }
}

TEST(PcdReader, TheDefaultViewpointIsNone) {
  const std::string text =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 "
      "0\nDATA ascii\n1 2 3\n";
  const auto file = parse_pcd(text, "a.pcd");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_FALSE(file->T_world_points);
  EXPECT_EQ(file->cloud.points.size(), 1U);
}

TEST(PcdReader, ErrorsSayWhereAndWhatWasExpected) {
  const auto error = [](const std::string& text) { return message(parse_pcd(text, "a.pcd")); };
  const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  expect_in("a.pcd:1: not a PCD file", error("hello\n"));
  expect_in("DATA", error(xyz));
  expect_in("as many entries", error("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n"));
  expect_in("\"z\"", error("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n"));
  expect_in("no fields x, y and z", error("FIELDS x\nSIZE 4\nTYPE F\nPOINTS 1\nDATA ascii\n"));
  expect_in("a.pcd:4: VIEWPOINT", error(xyz + "VIEWPOINT 0 0 0\nPOINTS 1\nDATA ascii\n"));
  expect_in("length is not 1", error(xyz + "VIEWPOINT 0 0 0 2 0 0 0\nPOINTS 1\nDATA ascii\n"));
  expect_in("a.pcd:4: POINTS", error(xyz + "POINTS many\nDATA ascii\n"));
  expect_in("a.pcd:6: expected 3 numbers", error(xyz + "POINTS 1\nDATA ascii\n1 2\n"));
  expect_in("1 of 2 points", error(xyz + "POINTS 2\nDATA ascii\n1 2 3\n"));
  expect_in("0 of 9000000000000000000 points",
            error(xyz + "POINTS 9000000000000000000\nDATA binary\n12345678"));
  expect_in("do not agree",
            error(xyz + "POINTS 1\nDATA binary_compressed\n" + std::string(8, '\0')));
}

TEST(Lzf, UndoesBackReferencesThatOverlapThemselves) {
  // 'a', then 2 + 7 + 3 = 12 bytes from one byte back.
  const std::string data{'\x00', 'a', '\xE0', '\x03', '\x00'};
  EXPECT_EQ(lzf_decompress(data, 13), std::string(13, 'a'));
  EXPECT_FALSE(lzf_decompress(data, 12));
  EXPECT_FALSE(lzf_decompress(data, 14));
  EXPECT_FALSE(lzf_decompress(data, std::size_t{1} << 40));
  EXPECT_FALSE(lzf_decompress(std::string{'\x20', '\x05'}, 3));  // before the beginning
}

// A deterministic, small relative of the fuzz targets.
TEST(CloudReaders, SurviveDamagedFiles) {
  PointCloud cloud;
  for (int i = 0; i < 20; ++i) cloud.points.emplace_back(static_cast<float>(i), 2.0F, 3.0F);
  cloud.colors.resize(20);
  const auto path = std::filesystem::path(testing::TempDir()) / "canopeer_damaged.ply";
  ASSERT_TRUE(write_ply(path, cloud));
  const std::string seeds[] = {*read_file(path),
                               kPcdHeader + std::string("binary\n") + pcd_values(false),
                               pcd_compressed(pcd_values(true))};
  Rng rng(1, "damage");
  for (const std::string& seed : seeds) {
    for (std::size_t size = 0; size < seed.size(); ++size) {
      EXPECT_FALSE(parse_ply(seed.substr(0, size), "a"));
      EXPECT_FALSE(parse_pcd(seed.substr(0, size), "a"));
    }
    for (int i = 0; i < 2000; ++i) {
      std::string damaged = seed;
      for (int c = 0; c < 3; ++c) {
        const auto at =
            static_cast<std::size_t>(rng.uniform(0.0, static_cast<double>(seed.size())));
        damaged[std::min(at, seed.size() - 1)] = static_cast<char>(rng.uniform(0.0, 256.0));
      }
      (void)parse_ply(damaged, "a");
      (void)parse_pcd(damaged, "a");
    }
  }
}

TEST(CloudFiles, CapitalsAndOtherNamesOfColumnsAreKnown) {
  const std::string values = "1 2 3 0 0 1 255 51 0\n";
  const std::string ply_types[] = {"uchar", "int", "ushort", "float"};
  for (const std::string& type : ply_types) {
    for (const char* prefix : {"", "diffuse_"}) {
      std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n";
      for (const char* name : {"X", "Y", "Z", "NX", "ny", "Nz"}) {
        text += std::string("property float ") + name + "\n";
      }
      for (const char* name : {"red", "green", "blue"}) {
        text += "property " + type + " " + prefix + name + "\n";
      }
      const auto file = parse_ply(text + "end_header\n" + values, "a.ply");
      ASSERT_TRUE(file) << file.error().message;
      EXPECT_EQ(file->cloud.points.at(0), Eigen::Vector3f(1, 2, 3));
      EXPECT_EQ(file->cloud.normals.at(0), Eigen::Vector3f(0, 0, 1));
      EXPECT_TRUE(file->cloud.colors.at(0) == (Rgb{255, 51, 0})) << type;
    }
  }
  const auto pcd = parse_pcd(
      "FIELDS X Y Z Normal_X Normal_Y Normal_Z R G B\nSIZE 4 4 4 4 4 4 4 4 4\nTYPE F F F F F F F F "
      "F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3 0 0 1 1 0.2 0\n",
      "a.pcd");
  ASSERT_TRUE(pcd) << pcd.error().message;
  EXPECT_EQ(pcd->cloud.normals.at(0), Eigen::Vector3f(0, 0, 1));
  EXPECT_TRUE(pcd->cloud.colors.at(0) == (Rgb{255, 51, 0}));
}

TEST(CloudFiles, ColoursOfSixteenBitsAreShortened) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty ushort red\nproperty ushort green\nproperty ushort blue\nend_header\n";
  const auto wide = parse_ply(head + "1 2 3 65535 13107 0\n1 2 3 257 0 0\n", "a.ply");
  EXPECT_TRUE(wide->cloud.colors.at(0) == (Rgb{255, 51, 0}));
  EXPECT_TRUE(wide->cloud.colors.at(1) == (Rgb{1, 0, 0}));
}

TEST(CloudFiles, AreToldByTheirContent) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto read = [&](const char* name, const std::string& bytes) {
    EXPECT_TRUE(write_file(folder / name, bytes));
    return read_cloud(folder / name);
  };
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n1 2 3\n";
  for (const char* name : {"canopeer_a.PLY", "canopeer_a.txt"}) {
    EXPECT_EQ(read(name, ply)->cloud.points.size(), 1U) << name;
  }
  EXPECT_EQ(read("canopeer_a.XYZ", "1 2 3\n4 5 6\n")->cloud.points.size(), 2U);
  expect_in("Git LFS",
            message(read("canopeer_b.ply", "version https://git-lfs.github.com/spec/v1\n")));
  expect_in("gzip", message(read("canopeer_c.pcd", "\x1F\x8B\x08")));
  expect_in("LAS", message(read("canopeer_d.txt", "LASF....")));
  EXPECT_TRUE(is_cloud_of_scanner("A.PCD"));
  EXPECT_FALSE(is_cloud_of_scanner("poses.txt"));
}

}  // namespace
}  // namespace canopeer
