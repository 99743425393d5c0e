#pragma once

#include <string>
#include <vector>

#include "canopeer/config/robot_mesh.h"

namespace tinyxml2 {
class XMLElement;
}  // namespace tinyxml2

namespace canopeer {

/// Reads the shapes of a URDF's links: box, cylinder, sphere, mesh, and capsule, which becomes a
/// cylinder and two spheres (its length is that between their centres, as everywhere). What cannot
/// be read is collected, so that it can be said at once.
class UrdfShapes {
 public:
  /// `file`: what the URDF is called in messages. `meshes` must outlive this.
  UrdfShapes(std::string file, RobotMeshReader& meshes)
      : file_(std::move(file)), meshes_(&meshes) {}

  /// The shapes of `link`; `tag`: "collision" or "visual".
  [[nodiscard]] std::vector<CollisionShape> read(const tinyxml2::XMLElement& link, const char* tag);

  /// What was wrong, with file, line and link, one line a cause: all meshes that are missing for
  /// the same reason share one. Empty: nothing.
  [[nodiscard]] std::vector<std::string> troubles() const;
  /// What can be done without: shapes of no size; and what is odd: very large meshes.
  [[nodiscard]] const std::vector<std::string>& notices() const { return notices_; }

 private:
  struct Trouble {
    std::string what;
    std::string first;                 // "robot.urdf:7: link 'a': mesh 'b.stl'"
    std::vector<std::string> meshes;   // names, the first one too
    std::vector<std::string> further;  // "9 'c.stl' (there is c.STL)"
    std::string near;                  // of the first
  };

  void read_one(const tinyxml2::XMLElement& element, std::vector<CollisionShape>& shapes);
  void read_mesh(const tinyxml2::XMLElement& mesh, const Pose& T_link_shape,
                 std::vector<CollisionShape>& shapes);
  void add(const tinyxml2::XMLElement& element, const std::string& what);
  [[nodiscard]] std::string place(const tinyxml2::XMLElement& element) const;

  std::string file_;
  RobotMeshReader* meshes_;
  std::string link_;  // that is being read
  std::vector<Trouble> troubles_;
  std::vector<std::string> notices_;
};

}  // namespace canopeer
