#include "canopeer/replay/frames/frame_head.h"

#include <cmath>

namespace canopeer::frames {

double rounded(double value, double step) {
  const double per_unit = std::round(1.0 / step);
  return std::isfinite(value) ? std::round(value * per_unit) / per_unit : 0.0;
}

Json from_time(double t_s) { return rounded(t_s, 1e-3); }

Json from(const Vec3& v) {
  return Json::array({rounded(v.x(), 1e-4), rounded(v.y(), 1e-4), rounded(v.z(), 1e-4)});
}

Json from(const Pose& pose) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column)
      rows.push_back(rounded(pose.matrix()(row, column), 1e-6));
  }
  return rows;
}

Json from(const Box& box) {
  Json corners = from(Vec3(box.min()));
  for (const Json& number : from(Vec3(box.max()))) corners.push_back(number);
  return corners;
}

Json from(const CameraIntrinsics& camera) {
  return {{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
          {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
}

}  // namespace canopeer::frames
