#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/named_factories.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/mission/ports.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/robot_model.h"
#include "canopeer/scene/scene.h"

namespace canopeer {

/// What stands behind a mission's ports: a simulated glasshouse, a robot.
class Site {
 public:
  virtual ~Site() = default;
  /// Valid as long as the site.
  [[nodiscard]] virtual Ports ports() = 0;
  /// The robot and the structure around it that is known, exactly.
  [[nodiscard]] virtual const ExactChecker& judge() const = 0;
  /// The mission's map, for sites that judge motions by what is known. The map outlives the site's
  /// last motion.
  virtual void watch_map(const VoxelMap* /*map*/) {}
  /// What is really there; null where nobody knows: on a real robot.
  [[nodiscard]] virtual const Scene* truth() const { return nullptr; }

  /// Where everything is between two steps of a mission, as bytes. The error: only a simulation in
  /// simulated time can be put back.
  [[nodiscard]] virtual Expected<std::string> save() const {
    return fail("this site cannot be put back to where it was");
  }
  [[nodiscard]] virtual Expected<void> restore(std::string_view /*state*/) {
    return fail("this site cannot be put back to where it was");
  }
};

/// What is said while a site is made; all may be empty.
struct SiteCallbacks {
  std::function<void(const ImportProgress&)> on_import{};    ///< how far a long import is
  std::function<void(const std::string& text)> on_news{};    ///< what has been done
  std::function<void(const std::string& text)> on_notice{};  ///< what is missing or odd
};

/// What a site is made from; file and robot outlive it.
struct SiteRequest {
  const MissionFile& file;
  const RobotModel& robot;
  SiteCallbacks callbacks{};
};

/// The sites there are to choose from, by name (`--site`).
class SiteRegistry
    : public NamedFactories<Expected<std::unique_ptr<Site>>(const SiteRequest& request)> {
 public:
  /// Those of this library: simulation.
  [[nodiscard]] static SiteRegistry built_in();
  /// The site called `name`; the error lists the names there are, or is the factory's.
  [[nodiscard]] Expected<std::unique_ptr<Site>> make(std::string_view name,
                                                     const SiteRequest& request) const;

 private:
  SiteRegistry() : NamedFactories("site") {}
};

}  // namespace canopeer
