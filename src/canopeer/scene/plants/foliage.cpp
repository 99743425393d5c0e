#include "canopeer/scene/plants/foliage.h"

#include <algorithm>
#include <cmath>

#include "canopeer/geometry/angles.h"
#include "canopeer/scene/plants/statistics.h"

namespace canopeer {
namespace {

constexpr double kPairedTop = 0.16;  // below the tip, two leaves a node
constexpr double kBladeArea = 0.73;  // of length · width

struct Slot {
  std::size_t shoot;
  double below_tip_m;
  double azimuth_rad;
  bool in_pair;
  bool second;
};

/// Nodes of one shoot from the tip down to `lowest` above its base.
std::vector<Slot> nodes_of(const Shoot& shoot, std::size_t index, double lowest, Rng& rng) {
  std::vector<Slot> slots;
  double azimuth = rng.uniform(0.0, 2.0 * kPi);
  double below = rng.uniform(0.004, 0.018);
  while (below < shoot.length_m - lowest) {
    azimuth += kDegree * rng.normal(123.0, 35.0);
    const bool pair = below < kPairedTop;
    slots.push_back({index, below, azimuth, pair, false});
    if (pair) slots.push_back({index, below, azimuth + kDegree * rng.normal(0, 20), true, true});
    below += pair ? clipped_normal(rng, 0.030, 0.008, 0.012, 0.05)
                  : clipped_normal(rng, 0.048, 0.021, 0.012, 0.10);
  }
  return slots;
}

/// Exactly `count` slots: surplus ones fall off (old leaves first, as a grower or shade takes
/// them), missing ones come as second leaves of single nodes.
void adjust_count(std::size_t count, Rng& rng, std::vector<Slot>* slots) {
  while (slots->size() > count) {
    // The lower of two random ones.
    const std::size_t a = rng.index(slots->size());
    const std::size_t b = rng.index(slots->size());
    const std::size_t lower = (*slots)[a].below_tip_m > (*slots)[b].below_tip_m ? a : b;
    if ((*slots)[lower].below_tip_m > kPairedTop || rng.chance(0.1)) {
      slots->erase(slots->begin() + static_cast<std::ptrdiff_t>(lower));
    }
  }
  while (slots->size() < count) {
    Slot extra = (*slots)[rng.index(slots->size())];
    extra.azimuth_rad += kPi + rng.normal(0.0, 0.4);
    slots->push_back(extra);
  }
}

/// Petioles bend towards the aisle that their shoot leans to, where the light is.
void turn_to_light(const PlantKind& kind, const Shoot& shoot, Slot* slot) {
  const Vec3 lean = shoot.axis.back().position - shoot.axis.front().position;
  slot->azimuth_rad +=
      kind.light_turn_rad * std::sin(std::atan2(lean.y(), lean.x()) - slot->azimuth_rad);
}

/// Leaf area comes out at the kind's figure, give or take a plant's own variation.
void scale_to_area(double area_m2, Rng& rng, std::vector<PlacedLeaf>* leaves) {
  double sum = 0.0;
  for (const PlacedLeaf& l : *leaves) sum += kBladeArea * l.form.length_m * l.form.width_m;
  const double factor = std::sqrt(area_m2 * clipped_normal(rng, 1.0, 0.03, 0.94, 1.06) / sum);
  for (PlacedLeaf& l : *leaves) {
    l.form.length_m *= factor;
    l.form.width_m *= factor;
    l.form.petiole_m *= factor;
  }
}

int cut_points(const PlacedLeaf& leaf, const std::vector<HangingFruit>& fruits) {
  constexpr double kMargin = 0.005;
  const TriangleMesh blade = make_blade(leaf.form, petiole_end(leaf.form, leaf.node));
  int cuts = 0;
  for (const HangingFruit& fruit : fruits) {
    // The leaf is one arm's length of itself around its node.
    const double reach = leaf.form.petiole_m + leaf.form.length_m + fruit.form.length_m;
    if ((fruit.T_plant_fruit.translation() - leaf.node).norm() > reach) continue;
    for (const auto& v : blade.vertices) cuts += touches_fruit(fruit, v.cast<double>(), kMargin);
    for (int i = 1; i <= 4; ++i) {
      LeafForm part = leaf.form;
      part.petiole_m *= i / 4.0;
      cuts += touches_fruit(fruit, petiole_end(part, leaf.node), kMargin);
    }
  }
  return cuts;
}

/// Turns the leaf step by step until it cuts no fruit; keeps the best posture when none is free.
void turn_away(const std::vector<HangingFruit>& fruits, Rng& rng, PlacedLeaf* leaf) {
  int best_cuts = cut_points(*leaf, fruits);
  PlacedLeaf candidate = *leaf;
  for (int attempt = 0; attempt < 24 && best_cuts > 0; ++attempt) {
    candidate.form.azimuth_rad = leaf->form.azimuth_rad + rng.normal(0.0, 0.25 + 0.06 * attempt);
    candidate.form.blade_pitch_rad =
        std::clamp(leaf->form.blade_pitch_rad + rng.normal(0.0, 0.2), -1.45, 1.3);
    const int cuts = cut_points(candidate, fruits);
    if (cuts < best_cuts) {
      best_cuts = cuts;
      leaf->form = candidate.form;
    }
  }
}

/// Old leaves near the ground rest on it instead of growing into it: the leaf rises until it does.
void keep_above_ground(PlacedLeaf* leaf) {
  constexpr double kGround = 0.004;
  for (int i = 0; i < 24; ++i) {
    const Vec3 base = petiole_end(leaf->form, leaf->node);
    if (make_blade(leaf->form, base).bounds().min().z() > kGround) return;
    leaf->form.blade_pitch_rad += 0.12;
    leaf->form.petiole_pitch_rad = std::max(leaf->form.petiole_pitch_rad, 0.04 * i);
  }
}

}  // namespace

std::vector<PlacedLeaf> place_leaves(const PlantKind& kind, const std::vector<Shoot>& shoots,
                                     Rng& rng) {
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < shoots.size(); ++i) {
    const double lowest = shoots[i].fork ? 0.06 : std::min(0.08, 0.2 * shoots[i].length_m);
    const auto nodes = nodes_of(shoots[i], i, lowest, rng);
    slots.insert(slots.end(), nodes.begin(), nodes.end());
  }
  adjust_count(static_cast<std::size_t>(kind.leaves), rng, &slots);
  for (Slot& slot : slots) turn_to_light(kind, shoots[slot.shoot], &slot);

  std::vector<PlacedLeaf> leaves;
  for (const Slot& slot : slots) {
    PlacedLeaf leaf;
    leaf.form = draw_leaf(slot.below_tip_m, slot.in_pair, slot.second, rng);
    leaf.form.azimuth_rad = slot.azimuth_rad;
    leaf.below_tip_m = slot.below_tip_m;
    leaf.form.blade_pitch_rad = std::max(-1.45, leaf.form.blade_pitch_rad - kind.droop_rad);
    const Shoot& shoot = shoots[slot.shoot];
    leaf.node = shoot.at(shoot.length_m - slot.below_tip_m).position;
    leaves.push_back(leaf);
  }
  scale_to_area(kind.leaf_area_m2, rng, &leaves);
  for (PlacedLeaf& leaf : leaves) keep_above_ground(&leaf);
  return leaves;
}

void make_room(const std::vector<HangingFruit>& fruits, Rng& rng, std::vector<PlacedLeaf>* leaves) {
  for (PlacedLeaf& leaf : *leaves) {
    turn_away(fruits, rng, &leaf);
    keep_above_ground(&leaf);
  }
}

}  // namespace canopeer
