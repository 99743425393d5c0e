#include "canopeer/fruit/fruits_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace canopeer {
namespace {

using Json = nlohmann::ordered_json;

/// With as many digits as fruits.csv has, so that files stay readable.
Json number(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

Json vector(const Vec3& v, int decimals) {
  return {number(v.x(), decimals), number(v.y(), decimals), number(v.z(), decimals)};
}

Json fruit_json(const FruitEstimate& f) {
  Json json = {{"id", f.id},
               {"centre_m", vector(f.centre, 4)},
               {"semi_axes_m", vector(f.semi_axes_m, 4)},
               {"e1", number(f.e1, 3)},
               {"e2", number(f.e2, 3)},
               {"roll_pitch_yaw_rad", vector(f.roll_pitch_yaw_rad, 4)},
               {"volume_cm3", number(f.volume_cm3, 1)},
               {"points", f.points},
               {"confidence", number(f.confidence, 3)},
               {"centre_sd_m", vector(f.centre_sd_m, 4)},
               {"volume_sd_cm3", number(f.volume_sd_cm3, 1)},
               {"rms_m", number(f.rms_m, 4)},
               {"seen_share", number(f.seen_share, 3)},
               {"ripeness", ripeness_name(f.ripeness)},
               {"color", {f.color.r, f.color.g, f.color.b}},
               {"views", f.views},
               {"first_seen_s", number(f.first_seen_s, 2)},
               {"last_seen_s", number(f.last_seen_s, 2)},
               {"place", nullptr}};
  if (f.place) {
    json["place"] = {{"row", f.place->row},
                     {"side", std::string(1, f.place->side)},
                     {"along_m", number(f.place->along_m, 3)},
                     {"height_m", number(f.place->height_m, 3)}};
  }
  return json;
}

}  // namespace

std::string fruits_json(const std::vector<FruitEstimate>& fruits) {
  Json list = Json::array();
  for (const FruitEstimate& fruit : fruits) list.push_back(fruit_json(fruit));
  const Json json = {{"unit", "m"}, {"fruits", std::move(list)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace canopeer
