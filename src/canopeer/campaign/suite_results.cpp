#include "canopeer/campaign/suite_results.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace canopeer {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kFormat[] = "canopeer-bench-suite";
constexpr int kFormatVersion = 1;

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const SuiteRun& r) {
  return {{"world", r.world},
          {"protocol", r.protocol},
          {"planner", r.planner},
          {"seed", r.seed},
          {"fruits_total", r.fruits_total},
          {"detected", r.detected},
          {"detected_paper", r.detected_paper},
          {"auc", r.auc},
          {"mission_time_s", r.mission_time_s},
          {"views", r.views},
          {"false_positives", r.false_positives},
          {"surface_f1", json_of(r.surface_f1)},
          {"volume_error_mean", json_of(r.volume_error_mean)},
          {"joint_path_rad", r.joint_path_rad},
          {"collisions", r.collisions}};
}

Json json_of(const SuiteScore& s) {
  return {{"planner", s.planner},     {"protocol", s.protocol},
          {"number", s.value.mean},   {"low95", s.value.low95},
          {"high95", s.value.high95}, {"normalised", s.normalised},
          {"worlds", s.worlds},       {"runs", s.runs}};
}

std::optional<double> optional_number(const Json& object, const char* key) {
  const Json& value = object.at(key);
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

SuiteRun run_in(const Json& j) {
  SuiteRun r;
  r.world = j.at("world").get<std::string>();
  r.protocol = j.at("protocol").get<std::string>();
  r.planner = j.at("planner").get<std::string>();
  r.seed = j.at("seed").get<std::uint64_t>();
  r.fruits_total = j.at("fruits_total").get<int>();
  r.detected = j.at("detected").get<int>();
  r.detected_paper = j.at("detected_paper").get<int>();
  r.auc = j.at("auc").get<double>();
  r.mission_time_s = j.at("mission_time_s").get<double>();
  r.views = j.at("views").get<int>();
  r.false_positives = j.at("false_positives").get<int>();
  r.surface_f1 = optional_number(j, "surface_f1");
  r.volume_error_mean = optional_number(j, "volume_error_mean");
  r.joint_path_rad = j.at("joint_path_rad").get<double>();
  r.collisions = j.at("collisions").get<int>();
  return r;
}

SuiteScore score_in(const Json& j) {
  SuiteScore s;
  s.planner = j.at("planner").get<std::string>();
  s.protocol = j.at("protocol").get<std::string>();
  s.value.mean = j.at("number").get<double>();
  s.value.low95 = j.at("low95").get<double>();
  s.value.high95 = j.at("high95").get<double>();
  s.normalised = j.at("normalised").get<bool>();
  s.worlds = j.at("worlds").get<int>();
  s.runs = j.at("runs").get<int>();
  return s;
}

SuiteResults results_in(const Json& j) {
  SuiteResults results;
  results.canopeer_version = j.at("canopeer").get<std::string>();
  results.suite_version = j.at("suite").get<std::string>();
  results.suite_sha256 = j.at("suite_sha256").get<std::string>();
  results.split = j.at("split").get<std::string>();
  results.settings = j.at("settings").get<std::vector<std::string>>();
  for (const Json& run : j.at("runs")) results.runs.push_back(run_in(run));
  for (const Json& r : j.at("references")) {
    results.references.push_back({r.at("world").get<std::string>(),
                                  r.at("protocol").get<std::string>(), r.at("auc").get<double>(),
                                  r.at("by").get<std::string>()});
  }
  for (const Json& score : j.at("scores")) results.scores.push_back(score_in(score));
  return results;
}

}  // namespace

std::string suite_results_json(const SuiteResults& results) {
  Json json = {{"format", kFormat},
               {"format_version", kFormatVersion},
               {"canopeer", results.canopeer_version},
               {"suite", results.suite_version},
               {"suite_sha256", results.suite_sha256},
               {"split", results.split},
               {"settings", results.settings},
               {"scores", Json::array()},
               {"references", Json::array()},
               {"runs", Json::array()}};
  for (const SuiteScore& score : results.scores) json["scores"].push_back(json_of(score));
  for (const SuiteReference& r : results.references) {
    json["references"].push_back(
        {{"world", r.world}, {"protocol", r.protocol}, {"auc", r.auc}, {"by", r.by}});
  }
  for (const SuiteRun& run : results.runs) json["runs"].push_back(json_of(run));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Expected<SuiteResults> parse_suite_results(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format").get<std::string>() != kFormat ||
        json.at("format_version").get<int>() != kFormatVersion) {
      return fail(fmt::format("expected format {} {}, as `canopeer bench suite` writes it", kFormat,
                              kFormatVersion));
    }
    return results_in(json);
  } catch (const nlohmann::json::exception& error) {
    return fail(fmt::format("is no results file of `canopeer bench suite`: {}", error.what()));
  }
}

std::string suite_results_csv(const SuiteResults& results) {
  std::string text =
      "world,protocol,planner,seed,fruits_total,detected,detected_paper,auc,mission_time_s,views,"
      "false_positives,surface_f1,volume_error_mean,joint_path_rad,collisions\n";
  const auto field = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
  };
  for (const SuiteRun& r : results.runs) {
    text += fmt::format("{},{},{},{},{},{},{},{:.6g},{:.6g},{},{},{},{},{:.6g},{}\n", r.world,
                        r.protocol, r.planner, r.seed, r.fruits_total, r.detected, r.detected_paper,
                        r.auc, r.mission_time_s, r.views, r.false_positives, field(r.surface_f1),
                        field(r.volume_error_mean), r.joint_path_rad, r.collisions);
  }
  return text;
}

}  // namespace canopeer
