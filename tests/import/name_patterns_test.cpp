#include "canopeer/import/assembly/name_patterns.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

NamePatterns patterns(const NamePatternOptions& options) {
  auto compiled = NamePatterns::compile(options);
  EXPECT_TRUE(compiled.has_value());
  return *compiled;
}

TEST(NamePatterns, MatchAnyNameAPartHas) {
  const NamePatterns p = patterns({.fruit = "red|orange"});
  for (std::string PartNames::*name : {&PartNames::material, &PartNames::mesh, &PartNames::node,
                                       &PartNames::file, &PartNames::visual, &PartNames::model}) {
    PartNames names;
    names.*name = "pepper_red_2";
    EXPECT_EQ(p.class_of(names), PartClass::fruit);
    names.*name = "leaf";
    EXPECT_FALSE(p.class_of(names).has_value());
  }
  PartNames names;
  names.textures = {"leaf.png", "orange.png"};
  EXPECT_EQ(p.class_of(names), PartClass::fruit);
}

TEST(NamePatterns, TheMostSpecificNameDecides) {
  const NamePatterns p = patterns({.fruit = "pepper", .leaf = "leaf", .stem = "stem"});
  PartNames names;
  names.model = "pepper_plant";
  EXPECT_EQ(p.class_of(names), PartClass::fruit);
  names.material = "leaf_green";
  EXPECT_EQ(p.class_of(names), PartClass::leaf);
  names.material = "pepper_leaf";  // on one name the fruit comes first
  EXPECT_EQ(p.class_of(names), PartClass::fruit);
  names.material = "mat1";
  names.mesh = "stem_3";
  EXPECT_EQ(p.class_of(names), PartClass::stem);
}

TEST(NamePatterns, WithoutACountedPatternEveryFruitCounts) {
  PartNames names;
  names.material = "green";
  EXPECT_TRUE(patterns({.fruit = "green"}).counted(names));
  EXPECT_FALSE(patterns({.fruit = "green", .counted = "red"}).counted(names));
}

TEST(NamePatterns, AWrongExpressionIsNamed) {
  const auto wrong = NamePatterns::compile({.fruit = "red", .leaf = "(leaf"});
  ASSERT_FALSE(wrong.has_value());
  EXPECT_NE(wrong.error().message.find("leaf: '(leaf'"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
