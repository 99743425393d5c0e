// Clouds as tables of text: one cloud, in every tongue that programs write.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "canopeer/base/plain_text.h"
#include "canopeer/sensing/cloud_file.h"

namespace canopeer {
namespace {

CloudFile parsed(const std::string& text) {
  auto file = parse_csv_cloud(text, "a.csv");
  EXPECT_TRUE(file) << text << (file ? "" : file.error().message);
  return file ? *std::move(file) : CloudFile();
}

std::string error_of(const std::string& text) {
  const auto file = parse_csv_cloud(text, "a.csv");
  return file ? "no error" : file.error().message;
}

void expect_in(const std::string& part, const std::string& whole) {
  EXPECT_NE(whole.find(part), std::string::npos) << "\"" << part << "\" in: " << whole;
}

/// The text in UTF-16 with its mark.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    if (big_endian) bytes.push_back('\0');
    bytes.push_back(c);
    if (!big_endian) bytes.push_back('\0');
  }
  return bytes;
}

TEST(TableCloud, OneCloudInEveryTongue) {
  const std::string plain = "x,y,z\n0.5,-0.25,1\n0.75,2e-1,1.5\n";
  const std::string same[] = {
      plain,
      "\xEF\xBB\xBF" + plain,
      utf16(plain, false),
      utf16(plain, true),
      "//X,Y,Z\n0.5,-0.25,1\n0.75,0.2,1.5\n",
      "//X Y Z\r\n0.5 -0.25 1\r\n0.75 0.2 1.5\r\n",
      "# a cloud\n# x y z\n0.5 -0.25 1\n0.75 0.2 1.5\n",
      "% x, y, z\n0.5 -0.25 1\n0.75 0.2 1.5\n",
      "\"x\",\"y\",\"z\"\n\"0.5\",\"-0.25\",\"1\"\n\"0.75\",\"0.2\",\"1.5\"\n",
      "\"x\",\"y\",\"z\"\n\"0,5\",\"-0,25\",\"1\"\n\"0,75\",\"0,2\",\"1,5\"\n",
      "x;y;z\n0,5;-0,25;1\n0,75;0,2;1,5\n",
      "x;y;z\n0.5;-0.25;1\n0.75;0.2;1.5\n",
      "x\ty\tz\n0.5\t-0.25\t1\n0.75\t0.2\t1.5\n",
      "x [m]\ty [m]\tz [m]\n0,5\t-0,25\t1\n0,75\t0,2\t1,5\n",
      "x y z\n0,5 -0,25 1,0\n0,75 0,2 1,5\n",
      "x|y|z\n0.5|-0.25|1\n0.75|0.2|1.5\n",
      ",x,y,z\n0,0.5,-0.25,1\n1,0.75,0.2,1.5\n",
      "\"x\" \"y\" \"z\"\n\"1\" 0.5 -0.25 1\n\"2\" 0.75 0.2 1.5\n",
      "Z,label,Y,X\n1,leaf,-0.25,0.5\n1.5,ripe fruit,0.2,0.75\n",
      "Points:0,Points:1,Points:2\n0.5,-0.25,1\n0.75,0.2,1.5\n",
      "x_m,y_m,z_m,\n0.5,-0.25,1,\n0.75,0.2,1.5,\n",
      "0.5 -0.25 1\n0.75 0.2 1.5\n",
      "  0.5   -0.25  1.0 \n\n 0.75    0.2   1.5\n",
      "0.5, -0.25, 1\n0.75, 0.2, 1.5\n",
      "2\n0.5 -0.25 1\n0.75 0.2 1.5\n",
      "1\n0.5 -0.25 1\n1\n0.75 0.2 1.5\n",
      "x,y,z\r0.5,-0.25,1\r0.75,0.2,1.5\r",
  };
  for (const std::string& text : same) {
    const CloudFile file = parsed(text);
    ASSERT_EQ(file.cloud.points.size(), 2U) << text;
    EXPECT_TRUE(file.cloud.points[0].isApprox(Eigen::Vector3f(0.5F, -0.25F, 1.0F))) << text;
    EXPECT_TRUE(file.cloud.points[1].isApprox(Eigen::Vector3f(0.75F, 0.2F, 1.5F))) << text;
    EXPECT_TRUE(file.notices.empty()) << file.notices[0];
  }
}

TEST(TableCloud, ColoursGoToOneOr255Or65535) {
  const Rgb red{255, 51, 0};
  for (const char* rows : {"1,2,3,255,51,0\n4,5,6,0,0,0\n", "1,2,3,1,0.2,0\n4,5,6,0,0,0\n",
                           "1,2,3,1.0,0.2,0.0\n4,5,6,0,0,0\n", "1,2,3,65535,13107,0\n4,5,6,0,0,0\n",
                           "1,2,3,255.0,51.0,0.0\n4,5,6,0,0,0\n"}) {
    for (const char* head : {"x,y,z,red,green,blue\n", "X,Y,Z,R,G,B\n", "//X,Y,Z,Rf,Gf,Bf\n"}) {
      const CloudFile file = parsed(std::string(head) + rows);
      ASSERT_EQ(file.cloud.colors.size(), 2U) << rows;
      EXPECT_TRUE(file.cloud.colors[0] == red) << head << rows;
      EXPECT_TRUE(file.cloud.colors[1] == Rgb{}) << head << rows;
    }
  }
  for (const char* rows : {"1 2 3 #ff3300\n", "1 2 3 16724736\n"}) {
    EXPECT_TRUE(parsed(std::string("x y z rgb\n") + rows).cloud.colors.at(0) == red) << rows;
  }
}

TEST(TableCloud, MissingValuesAreNoPoints) {
  const CloudFile file = parsed("x,y,z\n1,2,3\n,2,3\n1,nan,3\n1,2,NA\n1,inf,2\n");
  ASSERT_EQ(file.cloud.points.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_FALSE(file.cloud.points[i].allFinite()) << i;
}

TEST(TableCloud, ColumnsWithoutNamesAreTakenOnlyWhenTheyLeaveNoDoubt) {
  std::string normals, colors, counted, intensity, doubtful;
  for (int i = 0; i < 8; ++i) {
    const std::string xyz = "0." + std::to_string(i + 1) + " 0.2 1." + std::to_string(i);
    normals += xyz + (i % 2 == 0 ? " 0.6 0 0.8\n" : " 0 -0.8 -0.6\n");
    colors += xyz + " 200 " + std::to_string(i) + " 10\n";
    counted += std::to_string(i) + " " + xyz + "\n";
    intensity += xyz + " " + std::to_string(17 * i) + " 200 40 10\n";
    doubtful += xyz + " 0.5\n";
  }
  const CloudFile with_normals = parsed(normals);
  EXPECT_TRUE(with_normals.cloud.normals.at(1).isApprox(Eigen::Vector3f(0, -0.8F, -0.6F)));
  EXPECT_TRUE(with_normals.cloud.colors.empty());
  expect_in("columns 4 to 6 are normals", with_normals.notices.at(0));
  EXPECT_TRUE(parsed(colors).cloud.colors.at(7) == (Rgb{200, 7, 10}));
  const CloudFile with_index = parsed(counted);
  EXPECT_NEAR(with_index.cloud.points.at(7).x(), 0.8F, 1e-6F);
  expect_in("column 1 counts the rows", with_index.notices.at(0));
  const CloudFile pts = parsed("8\n" + intensity);
  EXPECT_TRUE(pts.cloud.colors.at(0) == (Rgb{200, 40, 10}));
  const CloudFile plain = parsed(doubtful);
  EXPECT_TRUE(plain.cloud.colors.empty());
  expect_in("column 4 passed over", plain.notices.at(0));
}

TEST(TableCloud, ErrorsSayWhereAndWhatToDo) {
  expect_in("a.csv:1: expected columns x, y and z, found a, b", error_of("a,b\n1,2\n"));
  expect_in("found x_mm", error_of("x_mm,y_mm,z_mm\n1,2,3\n"));
  expect_in("a.csv:3: expected a number, found 'three'", error_of("x,y,z\n1,2,3\n1,2,three\n"));
  expect_in("a.csv:3: expected 3 values, found 2", error_of("x,y,z\n1,2,3\n1,2\n"));
  expect_in("separate the columns by semicolons", error_of("x,y,z\n0,51,0,17,1,06\n"));
  expect_in("separate the columns by semicolons", error_of("0,51,0,17,1,06\n0,52,0,18,1,07\n"));
  expect_in("separate the columns by semicolons", error_of("1,5100,1,1700,1,6000\n"));
  const std::string with_colors = "0,51,0,17,1,06,200,40,10\n0,52,0,18,1,07,200,40,10\n";
  expect_in("a.csv:2: expected 6 values, found 9; if these are decimal commas, separate",
            error_of("x,y,z,r,g,b\n" + with_colors));
  expect_in("separate the columns by semicolons", error_of(with_colors));
  expect_in("separate the columns by semicolons", error_of("1,5100,1,1700,1,6000,200,40,10\n"));
  EXPECT_EQ(parsed("515,178,1067,200,40,100,0.5\n").cloud.points.at(0),
            Eigen::Vector3f(515, 178, 1067));
  EXPECT_EQ(parsed("515,178,1067,200,40,100\n").cloud.points.at(0),
            Eigen::Vector3f(515, 178, 1067));
  expect_in("holds 2 of the 3 points", error_of("3\n1 2 3\n4 5 6\n"));
  for (const char* count : {"400", "9223372036854775807"}) {
    expect_in("a.csv:1: states " + std::string(count) + " points, more than the file has room for",
              error_of(count + std::string("\n1 2 3\n4 5 6\n")));
  }
  expect_in("a.csv:3: states 9223372036854775807 points",
            error_of("1\n1 2 3\n9223372036854775807\n4 5 6\n"));
  expect_in("no text", error_of(std::string("x,y,z\n1,2,3\0\n", 13)));
  expect_in("expected columns", error_of(""));
  expect_in("expected columns", error_of("12\n"));
  expect_in("expected columns", error_of("1 2\n3 4\n"));
}

TEST(PlainText, KeepsWhatIsPlain) {
  const std::string text = "ä\r\n€\n";
  const PlainText plain(text);
  EXPECT_EQ(plain.view().data(), text.data());
  const std::string wide("\xFF\xFE\xE4\0\xAC\x20\x3C\xD8\x4D\xDF\0\xD8x\0", 14);
  EXPECT_EQ(PlainText(wide).view(), "ä€🍍\xEF\xBF\xBDx");
}

}  // namespace
}  // namespace canopeer
