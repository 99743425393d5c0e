// The paths that planning runs through thousands of times a second take no memory.

#include <atomic>
#include <cstdlib>
#include <new>

#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/straight_timing.h"
#include "canopeer/robot/view_ik.h"
#include "robot_fixture.h"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace canopeer {
namespace {

/// Allocations of a second call: the first may make room that is kept.
template <typename Work>
long allocations_of(Work&& work) {
  work();
  const long before = allocations;
  work();
  return allocations - before;
}

class Allocation : public ::testing::Test {
 protected:
  Allocation() {
    checker_.set_map(&field_);
    for (int i = 0; i < 200; ++i) qs_.push_back(random_configuration(random_, robot_));
  }

  Rng random_{3};
  const RobotModel& robot_ = shipped_robot();
  VoxelMap map_ = random_leaves(random_, robot_, {}, 60);
  DistanceField field_ = field_around(map_, robot_, {});
  CollisionChecker checker_{robot_, {}};
  std::vector<Configuration> qs_;
};

TEST_F(Allocation, TheCounterCounts) {
  EXPECT_GT(allocations_of([] { delete new int(1); }), 0);
}

TEST_F(Allocation, ForwardKinematicsTakesNone) {
  std::vector<Pose> poses(robot_.moving_links().size());
  double sum = 0.0;
  EXPECT_EQ(allocations_of([&] {
              for (const Configuration& q : qs_) {
                robot_.moving_link_poses(q, Pose::Identity(), poses.data());
                sum += poses[0](0, 3) + robot_.T_base_camera(q)(0, 3);
              }
            }),
            0);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST_F(Allocation, InverseKinematicsOfViewsTakesNone) {
  const auto closed = ArmIk::make(robot_);
  const auto numeric = ArmIk::make_numeric(robot_);
  ASSERT_TRUE(closed && numeric);
  for (const ArmIk* ik : {&*closed, &*numeric}) {
    std::vector<Configuration> found;
    EXPECT_EQ(allocations_of([&] {
                for (const Configuration& q : qs_) {
                  const Pose T = robot_.T_base_camera(q);
                  ik->solve_view(T.translation(), T * Vec3(0.0, 0.0, 0.5), qs_[0], found);
                }
              }),
              0);
  }
}

TEST_F(Allocation, CollisionChecksAndTimingOfEdgesTakeNone) {
  int free = 0;
  double time_s = 0.0;
  EXPECT_EQ(allocations_of([&] {
              for (std::size_t i = 1; i < qs_.size(); ++i) {
                const Configuration near = qs_[i] + 0.05 * (qs_[i - 1] - qs_[i]);
                free += checker_.state_free(qs_[i]) ? 1 : 0;
                free += checker_.edge_free(qs_[i], near) ? 1 : 0;
                time_s += motion_time(qs_[i], near, robot_.limits());
              }
            }),
            0);
  EXPECT_GT(free, 0);
  EXPECT_GT(time_s, 0.0);
}

}  // namespace
}  // namespace canopeer
