#include "canopeer/import/meshes/collada_asset.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

std::string file_with(const std::string& asset) {
  return "<?xml version=\"1.0\"?>\n<COLLADA>\n  <asset>" + asset + "</asset>\n</COLLADA>";
}

TEST(ColladaAsset, TheUnitsValueCountsNotItsName) {
  const auto asset = parse_collada_asset(
      file_with("<unit name=\"meter\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis>"), "a.dae");
  ASSERT_TRUE(asset.has_value());
  EXPECT_DOUBLE_EQ(asset->unit_m, 0.0254);
  EXPECT_EQ(asset->up, UpAxis::z);
}

TEST(ColladaAsset, HasColladasDefaultsWhereNothingIsSaid) {
  for (const std::string text : {"", "<COLLADA/>", "<COLLADA><asset/></COLLADA>",
                                 "<COLLADA><asset><unit name=\"inch\"/></asset></COLLADA>"}) {
    const auto asset = parse_collada_asset(text, "a.dae");
    ASSERT_TRUE(asset.has_value()) << text;
    EXPECT_DOUBLE_EQ(asset->unit_m, 1.0);
    EXPECT_EQ(asset->up, UpAxis::y);
  }
}

TEST(ColladaAsset, IsReadInAnyDressXmlAllows) {
  const auto asset = parse_collada_asset(
      file_with("<!-- <unit meter=\"7\"/> <up_axis>X_UP</up_axis> -->\n<unit\n meter = '1e-2' "
                "name='centimeter' />\n<up_axis>\n X_UP </up_axis >"),
      "a.dae");
  ASSERT_TRUE(asset.has_value());
  EXPECT_DOUBLE_EQ(asset->unit_m, 0.01);
  EXPECT_EQ(asset->up, UpAxis::x);
}

TEST(ColladaAsset, OnlyTheDocumentsOwnAssetCounts) {
  const auto asset = parse_collada_asset(
      file_with("<up_axis>Z_UP</up_axis>") + "<asset><unit meter=\"0.5\"/></asset>", "a.dae");
  ASSERT_TRUE(asset.has_value());
  EXPECT_DOUBLE_EQ(asset->unit_m, 1.0);
}

TEST(ColladaAsset, SaysWhereAUnitOrAnAxisIsWrong) {
  for (const char* meter : {"0", "-1", "cm", "1 m", "nan", "inf", "1e300", ""}) {
    const auto asset =
        parse_collada_asset(file_with("\n<unit meter=\"" + std::string(meter) + "\"/>"), "a.dae");
    ASSERT_FALSE(asset.has_value()) << meter;
    EXPECT_NE(asset.error().message.find("a.dae:4: <unit meter"), std::string::npos)
        << asset.error().message;
  }
  const auto asset = parse_collada_asset(file_with("<up_axis>UP</up_axis>"), "a.dae");
  ASSERT_FALSE(asset.has_value());
  EXPECT_NE(asset.error().message.find("expected X_UP, Y_UP or Z_UP"), std::string::npos);
}

}  // namespace
}  // namespace canopeer
