#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/named_factories.h"
#include "canopeer/config/mission_file.h"
#include "canopeer/mission/listeners.h"
#include "canopeer/mission/ports.h"
#include "canopeer/mission/steering.h"
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
  /// Who watches runs from there, to tell others of them; null: nobody.
  [[nodiscard]] virtual std::shared_ptr<Watcher> watcher() { return nullptr; }
  /// Who may steer runs from there; null: nobody. Valid as long as the site.
  [[nodiscard]] virtual Steering* steering() { return nullptr; }
  /// The mission is over, well or not: what may still move is told to stop.
  virtual void end_motion() {}
  /// Where the run's results will lie.
  virtual void results_in(const std::filesystem::path& /*out*/) {}
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

/// What is said while a site is made, and later; all may be empty.
struct SiteCallbacks {
  std::function<void(const ImportProgress&)> on_import{};    ///< how far a long import is
  std::function<void(const std::string& text)> on_news{};    ///< what has been done
  std::function<void(const std::string& text)> on_notice{};  ///< what is missing or odd
  // As long as the site lives:
  std::function<void(const std::string& text)> on_message{};  ///< what a person should know or do
  /// Whether a person wants the run to stop: motions under way end then, too.
  std::function<bool()> stop_asked{};
  /// Whether they want it so much that the arm stays where it is instead of going home.
  std::function<bool()> stop_at_once{};
};

/// What a stage has to know of a site before it is made.
struct SiteManners {
  bool realtime = false;  ///< its time is the wall clock's, whether or not that is asked for
  /// How fast the arm moves there, of what its limits allow, (0, 1]. The stage's robot has limits
  /// by which every motion takes 1/speed as long. Empty: 1.
  std::function<double(const MissionFile& file)> arm_speed{};
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
  /// As add(), of a site with manners of its own.
  [[nodiscard]] Expected<void> add_with_manners(const std::string& name,
                                                const std::string& one_line, const Factory& factory,
                                                SiteManners manners);
  [[nodiscard]] SiteManners manners(std::string_view name) const;
  /// The site called `name`; the error lists the names there are, or is the factory's.
  [[nodiscard]] Expected<std::unique_ptr<Site>> make(std::string_view name,
                                                     const SiteRequest& request) const;

 private:
  SiteRegistry() : NamedFactories("site") {}

  std::map<std::string, SiteManners, std::less<>> manners_;  // of those that have any
};

}  // namespace canopeer
