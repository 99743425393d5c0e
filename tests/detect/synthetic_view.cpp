#include "synthetic_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace canopeer::synthetic {
namespace {

const Body* nearest(const std::vector<Body>& bodies, const Vec3& p, double& distance) {
  const Body* best = nullptr;
  distance = 1e9;
  for (const Body& body : bodies) {
    const double d = body.distance(p);
    if (d < distance) {
      distance = d;
      best = &body;
    }
  }
  return best;
}

Vec3 normal(const Body& body, const Vec3& p) {
  constexpr double h = 1e-5;
  Vec3 n;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = h * Vec3::Unit(axis);
    n[axis] = body.distance(p + step) - body.distance(p - step);
  }
  return n.normalized();
}

Rgb shaded(const Body& body, const Vec3& p, const Vec3& ray) {
  const Vec3 light = Vec3(0.3, -0.2, 0.9).normalized();
  const Vec3 n = normal(body, p);
  const double lambert = 0.4 + 0.6 * std::max(0.0, n.dot(light));
  const Vec3 mirrored = ray - 2.0 * ray.dot(n) * n;
  const double highlight = 60.0 * std::pow(std::max(0.0, mirrored.dot(light)), 20.0);
  const auto channel = [&](int base) {
    return static_cast<std::uint8_t>(std::min(255.0, base * lambert + highlight));
  };
  return {channel(body.color.r), channel(body.color.g), channel(body.color.b)};
}

}  // namespace

Body ball(const Vec3& centre, double radius, Rgb color, bool fruit) {
  return {[=](const Vec3& p) { return (p - centre).norm() - radius; }, color, fruit};
}

Body superellipsoid(const Vec3& centre, const Vec3& semi_axes, double e, Rgb color, bool fruit) {
  return {[=](const Vec3& p) {
            const Vec3 q = p - centre;
            const double to_bound = q.norm() - 1.8 * semi_axes.maxCoeff();
            if (to_bound > 0.01) return to_bound;  // the exact form is slow
            const Vec3 s = q.cwiseAbs().cwiseQuotient(semi_axes);
            const double f = std::pow(
                std::pow(s.x(), 2 / e) + std::pow(s.y(), 2 / e) + std::pow(s.z(), 2 / e), e / 2);
            return f > 1e-9 ? 0.5 * q.norm() * (1.0 - 1.0 / f) : -0.5 * semi_axes.minCoeff();
          },
          color, fruit};
}

Body block(const Box& box, Rgb color) {
  return {[=](const Vec3& p) {
            const Vec3 d = (p - box.center()).cwiseAbs() - 0.5 * box.sizes();
            return d.cwiseMax(0.0).norm() + std::min(d.maxCoeff(), 0.0);
          },
          color, false};
}

Body bar(const Vec3& a, const Vec3& b, double radius, Rgb color) {
  return {[=](const Vec3& p) {
            const Vec3 axis = b - a;
            const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
            return (p - a - t * axis).norm() - radius;
          },
          color, false};
}

View look(const std::vector<Body>& bodies, const Vec3& from, const Vec3& to) {
  View view;
  RgbdFrame& frame = view.frame;
  frame.intrinsics = CameraIntrinsics::from_fov(320, 240, 40.0 / 180.0 * std::numbers::pi);
  frame.T_world_camera = look_at(from, to);
  frame.depth = DepthImage(320, 240, 0.0F);
  frame.color = ColorImage(320, 240, Rgb{150, 155, 160});
  view.fruit = Mask(320, 240, 0);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const Vec3 ray_camera = frame.intrinsics.ray(u, v);
      const Vec3 ray = (frame.T_world_camera.linear() * ray_camera).normalized();
      double travelled = 0.1;
      for (int step = 0; step < 200 && travelled < 3.0; ++step) {
        const Vec3 p = from + travelled * ray;
        double distance = 0.0;
        const Body* body = nearest(bodies, p, distance);
        if (distance < 5e-5) {
          frame.depth.at(u, v) = static_cast<float>(travelled / ray_camera.norm());
          frame.color.at(u, v) = shaded(*body, p, ray);
          view.fruit.at(u, v) = body->fruit;
          break;
        }
        travelled += distance;
      }
    }
  }
  return view;
}

}  // namespace canopeer::synthetic
