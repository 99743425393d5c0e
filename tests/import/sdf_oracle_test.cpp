// Where every visual of a world lies: ours against libsdformat, on worlds drawn at random. Built
// only where libsdformat is found.

#include <gtest/gtest.h>

#include <ignition/math/Pose3.hh>
#include <sdf/Console.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <sstream>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"
#include "canopeer/import/sdf/sdf_world.h"
#include "world_files.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// "row::plant link visual" and its pose in the world, in the order of the scene.
using Places = std::vector<std::pair<std::string, Eigen::Matrix4d>>;

Places our_places(const test::WorldFiles& files, const fs::path& world) {
  const auto read = read_sdf_world(world, ModelPaths({files.models()}));
  EXPECT_TRUE(read.has_value()) << read.error().message << "\n" << *read_file(world);
  Places places;
  if (!read) return places;
  EXPECT_TRUE(read->notices.empty());
  for (const SdfVisual& v : read->visuals) {
    places.emplace_back(v.names.model + " " + v.names.link + " " + v.names.visual,
                        v.T_world_visual.matrix());
  }
  return places;
}

class Library {
 public:
  explicit Library(const test::WorldFiles& files) : files_(files) {
    sdf::Console::Instance()->SetQuiet(true);
    sdf::ParserConfig::GlobalConfig().SetFindCallback([this](const std::string& uri) {
      const std::string scheme = "model://";
      return uri.starts_with(scheme) ? (files_.models() / uri.substr(scheme.size())).string() : uri;
    });
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { sdf::ParserConfig::GlobalConfig().SetFindCallback({}); }

  Places places(const fs::path& world) {
    places_.clear();
    sdf::Root root;
    expect_none(root.Load(world.string()), world);
    for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
      const sdf::World& each = *root.WorldByIndex(w);
      for (std::uint64_t i = 0; i < each.ModelCount(); ++i) {
        add(*each.ModelByIndex(i), "", Eigen::Matrix4d::Identity());
      }
    }
    return places_;
  }

 private:
  static void expect_none(const sdf::Errors& errors, const fs::path& world) {
    for (const sdf::Error& error : errors) {
      ADD_FAILURE() << error.Message() << "\n" << *read_file(world);
    }
  }

  static Eigen::Matrix4d resolved(const sdf::SemanticPose& semantic) {
    ignition::math::Pose3d pose;
    EXPECT_TRUE(semantic.Resolve(pose).empty());
    const auto& q = pose.Rot();
    Pose T = Pose::Identity();
    T.translation() = Vec3(pose.X(), pose.Y(), pose.Z());
    T.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
    return T.matrix();
  }

  void add(const sdf::Model& model, const std::string& scope, const Eigen::Matrix4d& T_world) {
    const Eigen::Matrix4d T_world_model = T_world * resolved(model.SemanticPose());
    const std::string name = scope + model.Name();
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const Eigen::Matrix4d T_world_link = T_world_model * resolved(link.SemanticPose());
      for (std::uint64_t k = 0; k < link.VisualCount(); ++k) {
        const sdf::Visual& visual = *link.VisualByIndex(k);
        places_.emplace_back(name + " " + link.Name() + " " + visual.Name(),
                             T_world_link * resolved(visual.SemanticPose()));
      }
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      add(*model.ModelByIndex(i), name + "::", T_world_model);
    }
  }

  const test::WorldFiles& files_;
  Places places_;
};

void expect_same(const Places& ours, const Places& theirs, double tolerance,
                 const fs::path& world) {
  ASSERT_EQ(ours.size(), theirs.size()) << *read_file(world);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    const auto& [name, T] = theirs[i];
    ASSERT_EQ(ours[i].first, name) << *read_file(world);
    EXPECT_LT((ours[i].second - T).norm(), tolerance) << name << "\n" << *read_file(world);
  }
}

/// Draws worlds of one version of SDF, with what that version knows.
class WorldWriter {
 public:
  WorldWriter(const test::WorldFiles& files, int minor, Rng& rng)
      : files_(files), minor_(minor), rng_(rng) {}

  fs::path write() {
    std::vector<std::string> known;  // names that poses may be relative to
    std::string text;
    for (std::size_t i = 1 + rng_.index(4); i-- > 0;) text += part(known, 2, true);
    return files_.add_world(text, version());
  }

  /// The library writes where a merged model goes as text with six digits.
  [[nodiscard]] double tolerance() const { return merges_ ? 1e-3 : 1e-9; }

 private:
  [[nodiscard]] std::string version() const { return "1." + std::to_string(minor_); }
  std::string name(const std::string& kind) { return kind + std::to_string(++names_); }
  std::string number(double limit) { return std::to_string(rng_.uniform(-limit, limit)); }

  std::string numbers(std::size_t count, double limit) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + number(limit);
    return text;
  }

  /// Of length 1 to the last digit, as the library does not see to it.
  std::string quaternion() {
    Eigen::Vector4d q;
    for (double& part : q) part = rng_.uniform(-1.0, 1.0);
    q.normalize();
    std::ostringstream text;
    text.precision(17);
    for (const double part : q) text << ' ' << part;
    return text.str();
  }

  /// A <pose>, perhaps relative to one of `known`, or none.
  std::string pose(const std::vector<std::string>& known, bool always = false) {
    if (!always && rng_.chance(0.2)) return "";
    std::string attributes;
    if (minor_ >= 5 && !known.empty() && rng_.chance(0.5)) {
      attributes =
          (minor_ < 7 ? " frame=\"" : " relative_to=\"") + known[rng_.index(known.size())] + "\"";
    }
    if (minor_ >= 9 && rng_.chance(0.2)) {
      return "<pose rotation_format=\"quat_xyzw\"" + attributes + ">" + numbers(3, 1.0) +
             quaternion() + "</pose>";
    }
    if (minor_ >= 9 && rng_.chance(0.3)) {
      return "<pose degrees=\"true\"" + attributes + ">" + numbers(3, 2.0) + " " +
             numbers(3, 180.0) + "</pose>";
    }
    return "<pose" + attributes + ">" + numbers(6, 3.0) + "</pose>";
  }

  std::string link(std::vector<std::string>& known) {
    const std::string own = name("link");
    const std::string where = pose(known);
    known.push_back(own);
    std::string text = "<link name=\"" + own + "\">" + where;
    for (std::size_t i = 1 + rng_.index(2); i-- > 0;) {
      text += "<visual name=\"" + name("visual") + "\">" + pose(known) +
              "<geometry><sphere><radius>1</radius></sphere></geometry></visual>";
    }
    return text + "</link>";
  }

  std::string frame(std::vector<std::string>& known) {
    const std::string own = name("frame");
    std::string attached;
    if (!known.empty() && rng_.chance(0.5)) {
      attached = " attached_to=\"" + known[rng_.index(known.size())] + "\"";
    }
    const std::string where = pose(known);
    known.push_back(own);
    return "<frame name=\"" + own + "\"" + attached + ">" + where + "</frame>";
  }

  std::string joint(std::vector<std::string>& known, const std::vector<std::string>& links) {
    const std::string own = name("joint");
    const std::string where = pose({});
    known.push_back(own);
    return "<joint name=\"" + own + "\" type=\"fixed\">" + where + "<parent>" + links[0] +
           "</parent><child>" + links[1] + "</child></joint>";
  }

  /// What stands in a model or a world; `known` gets the names it makes.
  std::string part(std::vector<std::string>& known, int depth, bool in_world) {
    const double draw = rng_.uniform();
    if (!in_world && (draw < 0.3 || depth == 0)) return link(known);
    if (minor_ >= 7 && draw < 0.45) return frame(known);
    if (draw < 0.75 || (!in_world && minor_ < 7)) return model(name("model"), known, depth - 1);
    return include(known, depth - 1, in_world);
  }

  /// The inside of a model; `inside` gets the names in it.
  std::string body(std::vector<std::string>& inside, int depth) {
    std::vector<std::string> links;
    std::string text;
    for (int i = 0; i < 2; ++i) {
      text += link(inside);
      links.push_back(inside.back());
    }
    if (minor_ >= 7 && rng_.chance(0.5)) text += joint(inside, links);
    for (std::size_t i = rng_.index(4); i-- > 0;) text += part(inside, depth, false);
    return text;
  }

  std::string placement(const std::vector<std::string>& inside) {
    if (minor_ < 8 || rng_.chance(0.5)) return "";
    return inside[rng_.index(inside.size())];
  }

  void make_known(const std::string& own, const std::vector<std::string>& inside,
                  std::vector<std::string>& known) {
    if (minor_ < 7) return;
    known.push_back(own);
    if (minor_ < 8) return;
    for (const std::string& each : inside) known.push_back(own + "::" + each);
  }

  std::string model(const std::string& own, std::vector<std::string>& known, int depth) {
    std::vector<std::string> inside;
    const std::string text = body(inside, std::max(depth, 0));
    const std::string placed = placement(inside);
    const std::string where = pose(known);
    make_known(own, inside, known);
    return "<model name=\"" + own + "\"" +
           (placed.empty() ? "" : " placement_frame=\"" + placed + "\"") + ">" + where + text +
           "</model>";
  }

  std::string include(std::vector<std::string>& known, int depth, bool in_world) {
    const std::string folder = name("folder");
    std::vector<std::string> inside;
    std::vector<std::string> none;
    const std::string text = body(inside, std::max(depth, 0));
    const std::string own_pose = minor_ < 7 ? pose({}) : "<pose>" + numbers(6, 3.0) + "</pose>";
    files_.add("models/" + folder + "/model.config",
               "<model><name>m</name><sdf version=\"1.2\">old.sdf</sdf><sdf version=\"" +
                   version() + "\">model.sdf</sdf><sdf version=\"9.9\">new.sdf</sdf></model>");
    files_.add("models/" + folder + "/model.sdf", "<sdf version=\"" + version() +
                                                      "\"><model name=\"" + folder + "_model\">" +
                                                      own_pose + text + "</model></sdf>");
    const bool merged = minor_ >= 9 && !in_world && rng_.chance(0.5);
    merges_ = merges_ || merged;
    const std::string own = name("included");
    const std::string placed = placement(inside);
    const std::string where = pose(known, !placed.empty());
    if (merged) {
      known.insert(known.end(), inside.begin(), inside.end());
    } else {
      make_known(own, inside, known);
    }
    return std::string("<include") + (merged ? " merge=\"true\"" : "") + "><uri>model://" + folder +
           "</uri><name>" + own + "</name>" + where +
           (placed.empty() ? "" : "<placement_frame>" + placed + "</placement_frame>") +
           "</include>";
  }

  const test::WorldFiles& files_;
  int minor_;
  Rng& rng_;
  int names_ = 0;
  bool merges_ = false;
};

class SdfOracleWorlds : public ::testing::TestWithParam<int> {};

TEST_P(SdfOracleWorlds, EveryVisualLiesWhereTheLibraryPutsIt) {
  // Other worlds: --gtest_random_seed=N.
  Rng rng(1 + static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()),
          "sdf worlds", static_cast<std::uint64_t>(GetParam()));
  std::size_t visuals = 0;
  for (int round = 0; round < 12 && !HasFailure(); ++round) {
    const test::WorldFiles files;
    WorldWriter writer(files, GetParam(), rng);
    const fs::path world = writer.write();
    const Places theirs = Library(files).places(world);
    expect_same(our_places(files, world), theirs, writer.tolerance(), world);
    visuals += theirs.size();
  }
  EXPECT_GT(visuals, 20U);
}

INSTANTIATE_TEST_SUITE_P(Versions, SdfOracleWorlds, ::testing::Values(4, 5, 6, 7, 8, 9),
                         [](const auto& version) {
                           return "Sdf1_" + std::to_string(version.param);
                         });

TEST(SdfOracle, FlattenedModelsAreModelsWithin) {
  // What Gazebo saved until SDF 1.7 of an included model: its links, with its name before theirs.
  const test::WorldFiles files;
  const std::string sphere = "<geometry><sphere><radius>1</radius></sphere></geometry></visual>";
  const fs::path world = files.add_world(
      "<model name=\"row\"><pose>1 0 0 0 0 1</pose><link name=\"base\"/>"
      "<frame name=\"plant::__model__\" attached_to=\"plant::stem\"><pose "
      "relative_to=\"__model__\">0 2 0 0 0 1</pose></frame>"
      "<link name=\"plant::stem\"><pose relative_to=\"plant::__model__\">0 0 1 0.5 0 0</pose>"
      "<visual name=\"v\"><pose>0 0 0.25 0 0 0</pose>" +
          sphere +
          "</link><link name=\"plant::leaf\"><pose relative_to=\"plant::stem\">1 0 0 0 0 "
          "0</pose><visual name=\"v\">" +
          sphere + "</link></model>",
      "1.7");
  const Places theirs = Library(files).places(world);
  EXPECT_EQ(theirs.size(), 2U);
  expect_same(our_places(files, world), theirs, 1e-9, world);
}

}  // namespace
}  // namespace canopeer
