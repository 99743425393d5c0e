#include "canopeer/geometry/state_archive.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

enum class Colour : std::uint8_t { red, blue };

/// One of everything that states are made of.
struct Leaf {
  int number = 0;
  bool fresh = false;
  Colour colour = Colour::red;
  std::optional<std::string> name;
  std::unique_ptr<double> weight;
  Vec3 place = Vec3::Zero();
  Pose pose = Pose::Identity();
  Eigen::VectorXd angles;
  std::array<float, 3> tint{};
  std::pair<int, double> pair;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(number, fresh, colour, name, weight, place, pose, angles, tint, pair);
  }
};

struct Plant {
  std::vector<Leaf> leaves;
  std::deque<Leaf> fallen;
  std::vector<std::vector<int>> whorls;
  std::vector<char> marks;
  std::vector<double> heights;
  std::unordered_map<int, std::string> names;
  Box box;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(leaves, fallen, whorls, marks, heights, names, box);
  }
};

Plant plant() {
  Plant p;
  p.leaves.resize(3);
  p.leaves[1].number = -7;
  p.leaves[1].fresh = true;
  p.leaves[1].colour = Colour::blue;
  p.leaves[1].name = "second";
  p.leaves[2].weight = std::make_unique<double>(0.1);
  p.leaves[2].place = {1.0, -2.0, 1e300};
  p.leaves[2].pose = look_at({0, 0, 1}, {1, 1, 1});
  p.leaves[2].angles = Eigen::VectorXd::LinSpaced(6, 0.0, 1.0);
  p.leaves[2].tint = {0.1F, 0.2F, 0.3F};
  p.leaves[2].pair = {4, 5.0};
  p.fallen.resize(2);
  p.whorls = {{1, 2}, {}, {3}};
  p.marks = {0, 1, 1};
  p.heights = {0.5, 0.25};
  p.names = {{3, "three"}};
  p.box = Box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  return p;
}

TEST(StateArchive, GivesBackWhatWasWritten) {
  const std::string bytes = state_bytes(plant(), 42);
  Plant back;
  int number = 0;
  ASSERT_TRUE(read_state_bytes(bytes, back, number).has_value());
  EXPECT_EQ(number, 42);
  ASSERT_EQ(back.leaves.size(), 3U);
  EXPECT_EQ(back.leaves[1].name, "second");
  EXPECT_EQ(*back.leaves[2].weight, 0.1);
  EXPECT_EQ(back.leaves[2].angles, plant().leaves[2].angles);
  EXPECT_TRUE(state_bytes(back, number) == bytes);
}

TEST(StateArchive, RefusesWhatIsCutShortOrTooLong) {
  const std::string bytes = state_bytes(plant());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Plant back;
    EXPECT_FALSE(read_state_bytes(std::string_view(bytes).substr(0, size), back)) << size;
  }
  Plant back;
  EXPECT_FALSE(read_state_bytes(bytes + "x", back));
}

TEST(StateArchive, TakesAnyBytes) {
  const std::string bytes = state_bytes(plant());
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    Plant back;
    refused += !read_state_bytes(damaged, back);
  }
  EXPECT_GT(refused, 1000);  // other numbers are only that, other lengths and flags are told
}

struct Wide {
  std::array<double, 4096> values{};

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(values);
  }
};

/// A length and nothing behind it.
template <typename Values>
bool believes(std::uint64_t length) {
  Values values;
  return read_state_bytes(state_bytes(length), values).has_value();
}

TEST(StateArchive, BelievesNoLengthThatThereAreNoBytesFor) {
  for (const std::uint64_t length : {std::uint64_t{1}, std::uint64_t{1} << 33, ~std::uint64_t{0}}) {
    EXPECT_FALSE(believes<std::string>(length));
    EXPECT_FALSE(believes<std::vector<double>>(length));
    EXPECT_FALSE(believes<std::vector<Leaf>>(length));
    EXPECT_FALSE(believes<std::deque<Leaf>>(length));
    EXPECT_FALSE((believes<std::unordered_map<int, Leaf>>(length)));
  }
  Eigen::MatrixXd matrix;
  const std::int32_t side = 1 << 30;
  EXPECT_FALSE(read_state_bytes(state_bytes(side, side), matrix));
  EXPECT_EQ(matrix.size(), 0);
}

TEST(StateArchive, ALongLengthBeforeManyBytesTakesMemoryInProportionToThem) {
  const std::string bytes = state_bytes(std::uint64_t{1} << 20, std::vector<char>(1 << 21));
  std::vector<Wide> wide;
  EXPECT_FALSE(read_state_bytes(bytes, wide));
  EXPECT_LT(wide.size(), 100U);
}

}  // namespace
}  // namespace canopeer
