#include "canopeer/record/yardstick.h"

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/record/event_json.h"

namespace canopeer {
namespace {

using event_json::Json;

// Every field with its key, in the order of the file: writer and reader cannot drift apart.

template <typename Point, typename Visit>
requires std::is_same_v<std::remove_const_t<Point>, FruitsByTime>
void visit_yardstick(Point& point, Visit&& visit) {
  visit("t_s", point.t_s);
  visit("fruits", point.fruits);
}

template <typename Bound, typename Visit>
requires std::is_same_v<std::remove_const_t<Bound>, UpperBound>
void visit_yardstick(Bound& bound, Visit&& visit) {
  visit("fruits", bound.fruits);
  visit("auc", bound.auc);
  visit("by", bound.by);
  visit("course", bound.course);
}

template <typename Best, typename Visit>
requires std::is_same_v<std::remove_const_t<Best>, BestResult>
void visit_yardstick(Best& best, Visit&& visit) {
  visit("detected", best.detected);
  visit("auc", best.auc);
  visit("planner", best.planner);
  visit("version", best.version);
  visit("seed", best.seed);
  visit("plan", best.plan);
  visit("settings", best.settings);
}

template <typename AnyYardstick, typename Visit>
requires std::is_same_v<std::remove_const_t<AnyYardstick>, Yardstick>
void visit_yardstick(AnyYardstick& yardstick, Visit&& visit) {
  visit("mission", yardstick.mission);
  visit("protocol", yardstick.protocol);
  visit("world_seed", yardstick.world_seed);
  visit("world_hash", yardstick.world_hash);
  visit("fruits_total", yardstick.fruits_total);
  visit("ceiling_fruits", yardstick.ceiling_fruits);
  visit("ceiling_surface", yardstick.ceiling_surface);
  visit("ceiling_views", yardstick.ceiling_views);
  visit("ceiling_seen_once", yardstick.ceiling_seen_once);
  visit("cover_views_90", yardstick.cover_views_90);
  visit("cover_views_100", yardstick.cover_views_100);
  visit("clairvoyant", yardstick.clairvoyant);
  visit("best_found", yardstick.best_found);
  visit("best_auc", yardstick.best_auc);
  visit("sampled", yardstick.sampled);
  visit("certified", yardstick.certified);
}

class YardstickWriter {
 public:
  template <typename T>
  static Json object(const T& value) {
    Json json = Json::object();
    visit_yardstick(value, [&](const char* key, const auto& field) { json[key] = of(field); });
    return json;
  }

 private:
  template <typename T>
  static Json of(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else {
      return object(value);
    }
  }
  template <typename T>
  static Json of(const std::optional<T>& value) {
    return value ? of(*value) : Json(nullptr);
  }
  template <typename T>
  static Json of(const std::vector<T>& values) {
    Json json = Json::array();
    for (const T& value : values) json.push_back(of(value));
    return json;
  }
};

/// What is wrong, and at which key: "best_auc.seed", "certified.course[3].t_s".
struct YardstickTrouble {
  std::string key;
  std::string what;
};

class YardstickReader {
 public:
  template <typename T>
  static void object(const Json& json, const std::string& at, T& value) {
    if (!json.is_object()) throw YardstickTrouble{at, "must be an object"};
    visit_yardstick(value, [&](const char* key, auto& field) {
      const std::string path = at.empty() ? key : at + "." + key;
      const auto found = json.find(key);
      member(found == json.end() ? Json() : *found, path, field);
    });
  }

 private:
  template <typename T>
  static void member(const Json& json, const std::string& at, T& value) {
    if (json.is_null()) throw YardstickTrouble{at, "is missing"};
    into(json, at, value);
  }
  template <typename T>
  static void member(const Json& json, const std::string& at, std::optional<T>& value) {
    value.reset();
    if (!json.is_null()) into(json, at, value.emplace());
  }
  template <typename T>
  static void member(const Json& json, const std::string& at, std::vector<T>& values) {
    values.clear();
    if (json.is_null()) return;
    if (!json.is_array()) throw YardstickTrouble{at, "must be a list"};
    for (const Json& entry : json) {
      const std::string place = at + "[" + std::to_string(values.size()) + "]";
      into(entry, place, values.emplace_back());
    }
  }

  /// Counts are whole numbers from 0 on, and no number is negative.
  template <typename T>
  static void into(const Json& json, const std::string& at, T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
      if (!json.is_string()) throw YardstickTrouble{at, "must be a text"};
      value = json.get<std::string>();
    } else if constexpr (std::is_integral_v<T>) {
      if (!json.is_number_unsigned() || !std::in_range<T>(json.get<std::uint64_t>())) {
        throw YardstickTrouble{at, "must be a whole number from 0 on"};
      }
      value = json.get<T>();
    } else if constexpr (std::is_floating_point_v<T>) {
      if (!json.is_number() || json.get<T>() < 0) {
        throw YardstickTrouble{at, "must be a number from 0 on"};
      }
      value = json.get<T>();
    } else {
      object(json, at, value);
    }
  }
};

}  // namespace

std::string yardstick_json(const Yardstick& yardstick) {
  return YardstickWriter::object(yardstick).dump(2, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

Expected<void> write_yardstick(const std::filesystem::path& path, const Yardstick& yardstick) {
  return write_file(path, yardstick_json(yardstick));
}

Expected<Yardstick> read_yardstick(const std::filesystem::path& path) {
  const Expected<std::string> text = read_file(path);
  if (!text) return fail(text.error().message);
  Yardstick yardstick;
  try {
    YardstickReader::object(Json::parse(*text), "", yardstick);
  } catch (const YardstickTrouble& trouble) {
    if (trouble.key.empty()) return fail(path.string() + ": " + trouble.what);
    return fail(path.string() + ": '" + trouble.key + "' " + trouble.what);
  } catch (const Json::exception& error) {
    return fail(path.string() + ": " + event_json::reason(error));
  }
  return yardstick;
}

}  // namespace canopeer
