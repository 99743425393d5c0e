#include "canopeer/import/meshes/file_kind.h"

#include <array>

namespace canopeer {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kPacked = "; unpack it first";
constexpr std::string_view kOtherMesh =
    "; open it in the program that made it, or in Blender, and export glTF (.glb), COLLADA or OBJ";
constexpr std::string_view kSolid =
    ", a CAD model without triangles; export a mesh of it: STL, OBJ or glTF";
constexpr std::string_view kPoints =
    ", a cloud of points without surfaces; make a mesh of it (PLY, OBJ or glTF)";
constexpr std::string_view kNotFetched =
    ", not the file itself; fetch what it stands for with 'git lfs pull' in its repository";
constexpr std::string_view kPage =
    ", not the file itself; download the file anew, by the address of its raw content";
constexpr std::string_view kScene = ", which is not read; export what it shows as glTF (.glb)";

struct Signature {
  std::size_t at;
  std::string_view bytes;
  std::string_view what;
  std::string_view advice;
};

constexpr std::array kSignatures = {
    Signature{0, "version https://git-lfs.github.com/spec"sv, "a Git LFS pointer", kNotFetched},
    Signature{0, "/annex/objects/"sv, "a git-annex pointer",
              ", not the file itself; fetch what it stands for with 'git annex get'"},
    Signature{0, "\x1f\x8b"sv, "packed with gzip", kPacked},
    Signature{0, "PK\x03\x04"sv, "a ZIP archive (3MF and USDZ are, too)", kPacked},
    Signature{0, "PK\x05\x06"sv, "an empty ZIP archive", ""},
    Signature{0, "BZh"sv, "packed with bzip2", kPacked},
    Signature{0,
              "\xfd"
              "7zXZ\0"sv,
              "packed with xz", kPacked},
    Signature{0, "7z\xbc\xaf\x27\x1c"sv, "a 7z archive", kPacked},
    Signature{0, "Rar!\x1a\x07"sv, "a RAR archive", kPacked},
    Signature{0, "\x28\xb5\x2f\xfd"sv, "packed with Zstandard", kPacked},
    Signature{257, "ustar"sv, "a tar archive", kPacked},
    Signature{0, "Kaydara FBX Binary"sv, "FBX", kOtherMesh},
    Signature{0, "; FBX "sv, "FBX as text", kOtherMesh},
    Signature{0, "BLENDER"sv, "a Blender file", "; open it in Blender and export glTF (.glb)"},
    Signature{0, "DRACO"sv, "a Draco mesh", kOtherMesh},
    // The version chunk: "MM" before it may begin the free header of an STL file.
    Signature{6, "\x02\0\x0a\0\0\0"sv, "3DS", kOtherMesh},
    Signature{2, "[MeshSerializer_v"sv, "an Ogre mesh",
              "; export glTF (.glb), COLLADA or OBJ from the program that made it"},
    Signature{0, "PXR-USDC"sv, "USD", kOtherMesh},
    Signature{0, "#usda "sv, "USD as text", kOtherMesh},
    Signature{0, "Ogawa"sv, "Alembic", kOtherMesh},
    Signature{0, "#VRML "sv, "VRML", kOtherMesh},
    Signature{0, "#X3D "sv, "X3D", kOtherMesh},
    Signature{0, "xof 0"sv, "a DirectX mesh", kOtherMesh},
    Signature{0, "OFF\n"sv, "an OFF mesh", kOtherMesh},
    Signature{0, "OFF\r\n"sv, "an OFF mesh", kOtherMesh},
    Signature{0, "\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0"sv, "a SketchUp model", kOtherMesh},
    Signature{0, "\xff\xfe"sv, "text in UTF-16", "; save it in UTF-8"},
    Signature{0, "\xfe\xff"sv, "text in UTF-16", "; save it in UTF-8"},
    Signature{0, "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"sv, "a document of 3ds Max or SolidWorks",
              kOtherMesh},
    Signature{0, "ISO-10303-21"sv, "STEP", kSolid},
    Signature{72, "S      1"sv, "IGES", kSolid},
    Signature{0, "AC10"sv, "DWG", kSolid},
    Signature{0, "3D Geometry File Format"sv, "a Rhino model", kSolid},
    Signature{0, "DBRep_DrawableShape"sv, "BREP", kSolid},
    Signature{0, "# .PCD"sv, "PCD", kPoints},
    Signature{0, "VERSION .7"sv, "PCD", kPoints},
    Signature{0, "LASF"sv, "LAS", kPoints},
    Signature{0, "ASTM-E57"sv, "E57", kPoints},
    Signature{0, "# Octomap OcTree"sv, "an OctoMap map", kScene},
    Signature{0, "#ROSBAG"sv, "a ROS bag", kScene},
    Signature{0, "%PDF"sv, "PDF", kScene},
    Signature{0, "<!DOCTYPE html"sv, "a web page", kPage},
    Signature{0, "<!doctype html"sv, "a web page", kPage},
    Signature{0, "<html"sv, "a web page", kPage},
};

bool begins_at(std::string_view head, std::size_t at, std::string_view bytes) {
  return at < head.size() && head.substr(at).starts_with(bytes);
}

bool holds(std::string_view head, std::string_view text) {
  return head.find(text) != std::string_view::npos;
}

}  // namespace

std::optional<std::string> foreign_file(std::string_view head) {
  if (head.empty()) return "is empty";
  for (const Signature& known : kSignatures) {
    if (!begins_at(head, known.at, known.bytes)) continue;
    return "is " + std::string(known.what) + std::string(known.advice);
  }
  return std::nullopt;
}

std::string_view mesh_ending_by_content(std::string_view head) {
  head = head.substr(0, kFileHeadBytes);
  if (head.starts_with("glTF")) return ".glb";
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ".ply";
  if (holds(head, "<COLLADA")) return ".dae";
  return {};
}

}  // namespace canopeer
