#include "canopeer/scene/ground_truth_csv.h"

#include <gtest/gtest.h>

#include "canopeer/scene/ground_truth_json.h"

namespace canopeer {
namespace {

TEST(GroundTruthCsv, HasOneRowPerFruit) {
  Scene scene;
  FruitTruth fruit;
  fruit.centre = Vec3(-0.75, 0.1, 0.4);
  fruit.length_m = 0.074;
  fruit.diameter_m = 0.068;
  fruit.volume_cm3 = 154.0;
  fruit.surface_cm2 = 150.0;
  fruit.plant = 3;
  scene.fruits.push_back(fruit);
  fruit.id = 1;
  fruit.ripeness = Ripeness::green;
  fruit.counted = false;
  scene.fruits.push_back(fruit);
  EXPECT_EQ(ground_truth_csv(scene),
            "id,class,counted,x_m,y_m,z_m,length_m,diameter_m,volume_cm3,surface_cm2,plant\n"
            "0,ripe,1,-0.75000,0.10000,0.40000,0.0740,0.0680,154.00,150.00,3\n"
            "1,green,0,-0.75000,0.10000,0.40000,0.0740,0.0680,154.00,150.00,3\n");
}

TEST(GroundTruthCsv, OfAnImportedSceneNamesModelsAndHulls) {
  Scene scene;
  scene.imported = true;
  FruitTruth fruit;
  fruit.model = "row::plant, 3";
  scene.fruits.push_back(fruit);
  EXPECT_EQ(ground_truth_csv(scene),
            "id,class,counted,x_m,y_m,z_m,length_m,diameter_m,hull_volume_cm3,surface_cm2,model\n"
            "0,ripe,1,0.00000,0.00000,0.00000,0.0000,0.0000,0.00,0.00,row::plant_ 3\n");
}

TEST(GroundTruthJson, HasOneObjectPerFruit) {
  Scene scene;
  scene.name = "a \"quoted\" name";
  scene.seed = 7;
  EXPECT_EQ(ground_truth_json(scene),
            "{\n  \"name\": \"a \\\"quoted\\\" name\",\n  \"seed\": 7,\n  \"imported\": false,\n"
            "  \"fruits_counted\": 0,\n  \"fruits\": []\n}\n");
  FruitTruth fruit;
  fruit.centre = Vec3(-0.75, 0.1, 0.4);
  fruit.length_m = 0.074;
  fruit.diameter_m = 0.068;
  fruit.volume_cm3 = 154.0;
  fruit.surface_cm2 = 150.0;
  fruit.plant = 3;
  scene.fruits = {fruit};
  EXPECT_NE(ground_truth_json(scene).find(
                "{\"id\": 0, \"class\": \"ripe\", \"counted\": true, \"x_m\": -0.75000, "
                "\"y_m\": 0.10000, \"z_m\": 0.40000, \"length_m\": 0.0740, \"diameter_m\": 0.0680, "
                "\"volume_cm3\": 154.00, \"surface_cm2\": 150.00, \"plant\": 3}"),
            std::string::npos);
}

}  // namespace
}  // namespace canopeer
