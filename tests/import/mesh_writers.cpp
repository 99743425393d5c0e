#include "mesh_writers.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>

namespace canopeer::test {
namespace {

/// From a file's axes to z up, as the COLLADA specification has them.
Eigen::Matrix3d upright(UpAxis up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == UpAxis::y) R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::x) R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return R;
}

std::string matrix_text(const Eigen::Affine3d& T) {
  std::ostringstream out;
  out.precision(17);
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) out << T.matrix()(r, c) << ' ';
  }
  return out.str();
}

void write_source(std::ostringstream& out, const std::string& id, int stride,
                  const std::vector<double>& numbers) {
  out << "<source id=\"" << id << "\"><float_array id=\"" << id << "-a\" count=\"" << numbers.size()
      << "\">";
  for (const double x : numbers) out << x << ' ';
  out << "</float_array><technique_common><accessor source=\"#" << id << "-a\" count=\""
      << numbers.size() / static_cast<std::size_t>(stride) << "\" stride=\"" << stride << "\">";
  for (int i = 0; i < stride; ++i) {
    out << "<param name=\"" << (stride == 3 ? "XYZ" : "ST")[i] << "\" type=\"float\"/>";
  }
  out << "</accessor></technique_common></source>";
}

void write_material(std::ostringstream& out, const Painted& s) {
  out << "<effect id=\"" << s.material << "-fx\"><profile_COMMON>";
  if (!s.texture.empty()) {
    out << "<newparam sid=\"surf\"><surface type=\"2D\"><init_from>" << s.material
        << "-img</init_from></surface></newparam><newparam sid=\"samp\"><sampler2D><source>surf"
           "</source></sampler2D></newparam>";
  }
  out << "<technique sid=\"common\"><lambert><diffuse>";
  if (s.texture.empty()) {
    out << "<color>" << s.color.r / 255.0 << ' ' << s.color.g / 255.0 << ' ' << s.color.b / 255.0
        << " 1</color>";
  } else {
    out << "<texture texture=\"samp\" texcoord=\"UV\"/>";
  }
  out << "</diffuse></lambert></technique></profile_COMMON></effect>";
}

}  // namespace

std::string dae(const std::vector<Painted>& surfaces, const DaeStyle& style) {
  std::ostringstream out;
  out.precision(17);
  const char* const axis = style.up == UpAxis::x ? "X_UP" : style.up == UpAxis::y ? "Y_UP" : "Z_UP";
  out << "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
         "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n<asset><unit "
         "name=\""
      << style.unit_name << "\" meter=\"" << style.unit_m << "\"/><up_axis>" << axis
      << "</up_axis></asset>\n<library_images>";
  for (const Painted& s : surfaces) {
    if (s.texture.empty()) continue;
    out << "<image id=\"" << s.material << "-img\"><init_from>" << s.texture
        << "</init_from></image>";
  }
  out << "</library_images>\n<library_effects>";
  for (const Painted& s : surfaces) write_material(out, s);
  out << "</library_effects>\n<library_materials>";
  for (const Painted& s : surfaces) {
    out << "<material id=\"" << s.material << "\" name=\"" << s.material
        << "\"><instance_effect url=\"#" << s.material << "-fx\"/></material>";
  }
  out << "</library_materials>\n<library_geometries><geometry id=\"geo\" "
         "name=\"plant_mesh\"><mesh>";
  const Eigen::Affine3d T_file_world =
      (Eigen::Affine3d(style.unit_m * upright(style.up)) * style.outer * style.node).inverse();
  std::vector<double> positions;
  std::vector<double> uv;
  for (const Painted& s : surfaces) {
    for (const auto& v : s.mesh.vertices) {
      const Vec3 p = T_file_world * v.cast<double>();
      positions.insert(positions.end(), {p.x(), p.y(), p.z()});
      uv.insert(uv.end(), {v.x(), v.y()});
    }
  }
  write_source(out, "pos", 3, positions);
  write_source(out, "uv", 2, uv);
  out << "<vertices id=\"vtx\"><input semantic=\"POSITION\" source=\"#pos\"/></vertices>";
  std::uint32_t offset = 0;
  for (const Painted& s : surfaces) {
    out << "\n<triangles count=\"" << s.mesh.triangles.size() << "\" material=\"" << s.material
        << "-sym\"><input semantic=\"VERTEX\" source=\"#vtx\" offset=\"0\"/><input "
           "semantic=\"TEXCOORD\" source=\"#uv\" offset=\"0\" set=\"0\"/><p>";
    for (const auto& t : s.mesh.triangles) {
      for (const auto i : t) out << i + offset << ' ';
    }
    out << "</p></triangles>";
    offset += static_cast<std::uint32_t>(s.mesh.vertices.size());
  }
  out << "</mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene "
         "id=\"scene\" name=\"scene\"><node id=\"outer\" name=\"outer\"><matrix>"
      << matrix_text(style.outer) << "</matrix><node id=\"inner\" name=\"inner\"><matrix>"
      << matrix_text(style.node)
      << "</matrix><instance_geometry url=\"#geo\"><bind_material><technique_common>";
  for (const Painted& s : surfaces) {
    out << "<instance_material symbol=\"" << s.material << "-sym\" target=\"#" << s.material
        << "\"><bind_vertex_input semantic=\"UV\" input_semantic=\"TEXCOORD\" "
           "input_set=\"0\"/></instance_material>";
  }
  out << "</technique_common></bind_material></instance_geometry></node></node></visual_scene>"
         "</library_visual_scenes>\n<scene><instance_visual_scene url=\"#scene\"/></scene>\n"
         "</COLLADA>\n";
  return out.str();
}

std::string obj(const std::vector<Painted>& surfaces, const std::string& mtl_file) {
  std::ostringstream out;
  out.precision(9);
  out << "mtllib " << mtl_file << "\n";
  std::uint32_t offset = 1;
  for (const Painted& s : surfaces) {
    out << "o " << s.material << "_object\nusemtl " << s.material << "\n";
    for (const auto& v : s.mesh.vertices) {
      out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << "\nvt " << v.x() << ' ' << v.y()
          << '\n';
    }
    for (const auto& t : s.mesh.triangles) {
      out << 'f';
      for (const auto i : t) out << ' ' << i + offset << '/' << i + offset;
      out << '\n';
    }
    offset += static_cast<std::uint32_t>(s.mesh.vertices.size());
  }
  return out.str();
}

std::string mtl(const std::vector<Painted>& surfaces) {
  std::ostringstream out;
  for (const Painted& s : surfaces) {
    out << "newmtl " << s.material << "\nKd " << s.color.r / 255.0 << ' ' << s.color.g / 255.0
        << ' ' << s.color.b / 255.0 << '\n';
    if (!s.texture.empty()) out << "map_Kd " << s.texture << '\n';
  }
  return out.str();
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string out(80, '\0');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  out.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                       .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                                       .normalized();
    out.append(reinterpret_cast<const char*>(normal.data()), 12);
    for (const auto i : t) out.append(reinterpret_cast<const char*>(mesh.vertices[i].data()), 12);
    out.append(2, '\0');
  }
  return out;
}

std::string colored_ply(const std::vector<Painted>& surfaces) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const Painted& s : surfaces) {
    vertices += s.mesh.vertices.size();
    faces += s.mesh.triangles.size();
  }
  std::ostringstream out;
  out.precision(9);
  out << "ply\nformat ascii 1.0\nelement vertex " << vertices
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty "
         "uchar green\nproperty uchar blue\nelement face "
      << faces << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Painted& s : surfaces) {
    for (const auto& v : s.mesh.vertices) {
      out << v.x() << ' ' << v.y() << ' ' << v.z() << ' ' << int{s.color.r} << ' ' << int{s.color.g}
          << ' ' << int{s.color.b} << '\n';
    }
  }
  std::uint32_t offset = 0;
  for (const Painted& s : surfaces) {
    for (const auto& t : s.mesh.triangles) {
      out << "3 " << t[0] + offset << ' ' << t[1] + offset << ' ' << t[2] + offset << '\n';
    }
    offset += static_cast<std::uint32_t>(s.mesh.vertices.size());
  }
  return out.str();
}

std::string ascii_stl(const TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  out << "solid thing\n";
  for (const auto& t : mesh.triangles) {
    out << "facet normal 0 0 1\nouter loop\n";
    for (const auto i : t) {
      const auto& v = mesh.vertices[i];
      out << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid thing\n";
  return out.str();
}

std::string binary_colored_ply(const std::vector<Painted>& surfaces) {
  std::string text = colored_ply(surfaces);
  text = text.substr(0, text.find("end_header\n") + 11);
  text.replace(text.find("ascii"), 5, "binary_little_endian");
  std::uint32_t offset = 0;
  std::string faces;
  for (const Painted& s : surfaces) {
    for (const auto& v : s.mesh.vertices) {
      text.append(reinterpret_cast<const char*>(v.data()), 12);
      text += {static_cast<char>(s.color.r), static_cast<char>(s.color.g),
               static_cast<char>(s.color.b)};
    }
    for (const auto& t : s.mesh.triangles) {
      faces += '\x03';
      for (const std::uint32_t i : {t[0] + offset, t[1] + offset, t[2] + offset}) {
        faces.append(reinterpret_cast<const char*>(&i), 4);
      }
    }
    offset += static_cast<std::uint32_t>(s.mesh.vertices.size());
  }
  return text + faces;
}

std::string gltf_bin(const std::vector<Painted>& surfaces) {
  std::string bytes;
  for (const Painted& s : surfaces) {
    for (const auto& v : s.mesh.vertices) {
      const Eigen::Vector3f p(v.x(), v.z(), -v.y());
      bytes.append(reinterpret_cast<const char*>(p.data()), 12);
    }
    for (const auto& t : s.mesh.triangles) {
      bytes.append(reinterpret_cast<const char*>(t.data()), 12);
    }
  }
  return bytes;
}

std::string gltf(const std::vector<Painted>& surfaces, const std::string& bin_file) {
  std::ostringstream views;
  std::ostringstream accessors;
  std::ostringstream materials;
  std::ostringstream primitives;
  std::size_t at = 0;
  int index = 0;
  for (const Painted& s : surfaces) {
    const char* const comma = index == 0 ? "" : ",";
    const std::size_t points = 12 * s.mesh.vertices.size();
    const std::size_t corners = 12 * s.mesh.triangles.size();
    const Box box = s.mesh.bounds();
    views << comma << R"({"buffer":0,"byteOffset":)" << at << R"(,"byteLength":)" << points
          << R"(},{"buffer":0,"byteOffset":)" << at + points << R"(,"byteLength":)" << corners
          << "}";
    accessors << comma << R"({"bufferView":)" << 2 * index
              << R"(,"componentType":5126,"type":"VEC3","count":)" << s.mesh.vertices.size()
              << R"(,"min":[)" << box.min().x() << ',' << box.min().z() << ',' << -box.max().y()
              << R"(],"max":[)" << box.max().x() << ',' << box.max().z() << ',' << -box.min().y()
              << R"(]},{"bufferView":)" << 2 * index + 1
              << R"(,"componentType":5125,"type":"SCALAR","count":)" << 3 * s.mesh.triangles.size()
              << "}";
    // Linear light, as the format has it; sRGB's curve nearly enough.
    const auto linear = [](int level) { return std::pow(level / 255.0, 2.2); };
    materials << comma << R"({"name":")" << s.material
              << R"(","pbrMetallicRoughness":{"baseColorFactor":[)" << linear(s.color.r) << ','
              << linear(s.color.g) << ',' << linear(s.color.b) << R"(,1]}})";
    primitives << comma << R"({"attributes":{"POSITION":)" << 2 * index << R"(},"indices":)"
               << 2 * index + 1 << R"(,"material":)" << index << "}";
    at += points + corners;
    ++index;
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"plant","mesh":0}],"meshes":[{"name":"plant_mesh","primitives":[)" +
         primitives.str() + R"(]}],"materials":[)" + materials.str() + R"(],"accessors":[)" +
         accessors.str() + R"(],"bufferViews":[)" + views.str() + R"(],"buffers":[{"uri":")" +
         bin_file + R"(","byteLength":)" + std::to_string(at) + "}]}";
}

TriangleMesh ball(const Vec3& centre, double radius) {
  constexpr std::uint32_t kAround = 16;
  constexpr std::uint32_t kRings = 8;
  TriangleMesh mesh;
  mesh.vertices.emplace_back((centre - radius * Vec3::UnitZ()).cast<float>());
  for (std::uint32_t i = 1; i < kRings; ++i) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double polar = std::numbers::pi * i / kRings;
      const double azimuth = 2.0 * std::numbers::pi * k / kAround;
      const Vec3 d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                   -std::cos(polar));
      mesh.vertices.emplace_back((centre + radius * d).cast<float>());
    }
  }
  mesh.vertices.emplace_back((centre + radius * Vec3::UnitZ()).cast<float>());
  const std::uint32_t top = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  const auto at = [](std::uint32_t ring, std::uint32_t k) {
    return 1 + ring * kAround + k % kAround;
  };
  for (std::uint32_t k = 0; k < kAround; ++k) {
    mesh.triangles.push_back({0, at(0, k + 1), at(0, k)});
    for (std::uint32_t i = 0; i + 2 < kRings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
    mesh.triangles.push_back({at(kRings - 2, k), at(kRings - 2, k + 1), top});
  }
  return mesh;
}

TriangleMesh sheet(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::pair{low.x(), low.y()},
                             {high.x(), low.y()},
                             {high.x(), high.y()},
                             {low.x(), high.y()}}) {
    mesh.vertices.emplace_back(Vec3(x, y, low.z()).cast<float>());
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

double volume_cm3(const TriangleMesh& mesh) { return mesh.volume() * 1e6; }

}  // namespace canopeer::test
