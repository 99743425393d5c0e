#include "world_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "canopeer/base/atomic_file.h"

namespace canopeer::test {

namespace fs = std::filesystem;

WorldFiles::WorldFiles() {
  std::string name = (fs::temp_directory_path() / "canopeer_world_XXXXXX").string();
  path_ = mkdtemp(name.data());
  fs::create_directories(models());
}

WorldFiles::~WorldFiles() {
  std::error_code code;
  fs::remove_all(path_, code);
}

fs::path WorldFiles::add(const std::string& name, const std::string& content) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  EXPECT_TRUE(write_file(path, content).has_value());
  return path;
}

void WorldFiles::add_model(const std::string& name, const std::string& link_content,
                           const std::string& under) const {
  const std::string folder = under + "/" + name + "/";
  add(folder + "model.config", "<?xml version=\"1.0\"?><model><name>" + name +
                                   "</name><sdf version=\"1.6\">model.sdf</sdf></model>");
  add(folder + "model.sdf", "<?xml version=\"1.0\"?>\n<sdf version=\"1.6\">\n<model name=\"" +
                                name + "\">\n<link name=\"link\">\n" + link_content +
                                "\n</link></model></sdf>");
}

fs::path WorldFiles::add_world(const std::string& content, const std::string& version) const {
  return add("world.world", "<?xml version=\"1.0\"?>\n<sdf version=\"" + version +
                                "\">\n<world name=\"test\">\n" + content + "\n</world>\n</sdf>\n");
}

std::string mesh_visual(const std::string& uri, const std::string& more) {
  return "<visual name=\"visual\"><geometry><mesh><uri>" + uri + "</uri>" + more +
         "</mesh></geometry></visual>";
}

std::string box_visual(const std::string& size, const std::string& more) {
  return "<visual name=\"visual\">" + more + "<geometry><box><size>" + size +
         "</size></box></geometry></visual>";
}

}  // namespace canopeer::test
