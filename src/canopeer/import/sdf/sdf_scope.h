#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/import/sdf/sdf_element.h"

namespace canopeer {

/// Where something lies: its <pose>, not looked at yet, and what that is relative to.
struct SdfPlace {
  SdfElement pose;               ///< none: the identity
  std::string base;              ///< a name, for a <pose> that names none itself; empty: the scope
  SdfElement owner;              ///< link, frame, joint, model or include, for messages
  Vec3 offset_m = Vec3::Zero();  ///< in the base, before `pose`: where a population puts a model

  /// "" when the scope itself is meant.
  [[nodiscard]] std::string relative_to() const;
};

struct SdfScope;

/// A link, or a model within.
struct SdfPart {
  SdfElement link;
  std::unique_ptr<SdfScope> model;  ///< null: a link
};

/// A model, or the world: what has names of its own. Includes are already in it.
struct SdfScope {
  std::string name;             ///< of a world: empty
  SdfScope* parent = nullptr;   ///< null: the world
  bool merged = false;          ///< its parts count as its parent's: <include merge="true">
  SdfPlace place;               ///< in its parent
  std::string placement_frame;  ///< which of its frames `place` speaks of; empty: its own
  std::map<std::string, SdfPlace> frames;   ///< links, joints and frames by name
  std::map<std::string, SdfScope*> models;  ///< by name
  std::vector<SdfPart> parts;               ///< in the order of the file
};

}  // namespace canopeer
