#include "canopeer/config/yaml_reader.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/yaml_document.h"

namespace canopeer {
namespace {

using Kind = YamlNode::Kind;

/// The unit a key's ending names, as " in metres"; empty: none.
std::string unit_of(std::string_view key) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 16> kUnits = {{
      {"_rad_s2", "rad/s²"},
      {"_m_s2", "m/s²"},
      {"_rad_s", "rad/s"},
      {"_m_s", "m/s"},
      {"_ms", "milliseconds"},
      {"_us", "microseconds"},
      {"_mm", "millimetres"},
      {"_cm", "centimetres"},
      {"_s", "seconds"},
      {"_m", "metres"},
      {"_deg", "degrees"},
      {"_rad", "radians"},
      {"_px", "pixels"},
      {"_hz", "hertz"},
      {"_cm3", "cm³"},
      {"_m3", "m³"},
  }};
  for (const auto& [ending, unit] : kUnits) {
    if (key.size() > ending.size() && key.substr(key.size() - ending.size()) == ending)
      return " in " + std::string(unit);
  }
  return {};
}

std::string shown(double value) {
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string shown(const YamlNode& node) {
  switch (node.kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return "'" + node.scalar + "'";
    case Kind::kSequence:
      return "a sequence of " + std::to_string(node.items.size());
    case Kind::kMap:
      return "a mapping";
  }
  return {};
}

std::string shown(NumberRange range) {
  if (std::isfinite(range.min) && std::isfinite(range.max))
    return " between " + shown(range.min) + " and " + shown(range.max);
  if (std::isfinite(range.min)) return " of at least " + shown(range.min);
  if (std::isfinite(range.max)) return " of at most " + shown(range.max);
  return {};
}

std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

template <typename Values, typename ToJson>
std::string json_list(const Values& values, ToJson to_json) {
  std::string list;
  for (const auto& value : values) list += (list.empty() ? "" : ", ") + to_json(value);
  return "[" + list + "]";
}

template <typename Number>
std::optional<Number> parse_number(const YamlNode& node) {
  if (node.kind != Kind::kScalar || node.quoted) return std::nullopt;
  Number value{};
  const char* const end = node.scalar.data() + node.scalar.size();
  const auto result = std::from_chars(node.scalar.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

}  // namespace

YamlMap::YamlMap(std::shared_ptr<YamlDocument> document, YamlNode* node, std::string path)
    : document_(std::move(document)), node_(node), path_(std::move(path)) {
  node_->visited = true;
}

Expected<YamlMap> YamlMap::load(const std::filesystem::path& path, std::string prefix) {
  auto text = read_file(path);
  if (!text) return fail(text.error().message);
  auto map = parse(*text, path.string());
  if (map) map->path_ = std::move(prefix);
  return map;
}

Expected<YamlMap> YamlMap::parse(std::string_view text, std::string name) {
  auto document = YamlDocument::parse(text, std::move(name));
  if (!document) return fail(document.error().message);
  YamlNode* const root = (*document)->root.get();
  return YamlMap(std::move(*document), root, {});
}

Expected<void> YamlMap::set(std::string_view dotted_key, std::string_view value) {
  const std::string where = "--set " + std::string(dotted_key);
  auto parsed = parse_yaml_value(value, where, false);
  if (!parsed) return fail(parsed.error().message);
  YamlNode* node = node_;
  while (true) {
    const std::size_t dot = dotted_key.find('.');
    const std::string key(dotted_key.substr(0, dot));
    if (key.empty()) return fail(where + ": expected key or map.key");
    if (node->kind != Kind::kMap) return fail(where + ": '" + key + "' is not inside a mapping");
    YamlNode* child = node->find(key);
    if (child == nullptr) {
      node->entries.emplace_back(key, std::make_unique<YamlNode>());
      child = node->entries.back().second.get();
      if (dot != std::string_view::npos) child->kind = Kind::kMap;
    }
    if (dot == std::string_view::npos) {
      *child = std::move(**parsed);
      return {};
    }
    node = child;
    dotted_key.remove_prefix(dot + 1);
  }
}

bool YamlMap::has(std::string_view key) const { return node_->find(key) != nullptr; }

bool YamlMap::is_text(std::string_view key) const {
  const YamlNode* const node = node_->find(key);
  return node != nullptr && node->kind == Kind::kScalar;
}

bool YamlMap::is_map(std::string_view key) const {
  const YamlNode* const node = node_->find(key);
  return node != nullptr && node->kind == Kind::kMap;
}

YamlNode* YamlMap::take(std::string_view key) {
  node_->asked.emplace(key);
  return node_->find(key);
}

YamlNode* YamlMap::take_required(std::string_view key) {
  YamlNode* const node = take(key);
  if (node == nullptr)
    document_->complaints.push_back(
        {true, node_->line, where() + ": key '" + std::string(key) + "' is missing"});
  return node;
}

void YamlMap::complain_at(const YamlNode& node, std::string_view key, const std::string& message) {
  document_->complaints.push_back(
      {false, node.line, document_->place(node) + ": " + std::string(key) + ": " + message});
}

void YamlMap::complain(std::string_view key, const std::string& message) {
  const YamlNode* const node = node_->find(key);
  complain_at(node == nullptr ? *node_ : *node, key, message);
}

double YamlMap::to_number(const YamlNode& node, std::string_view key, NumberRange range,
                          double fallback) {
  const auto value = parse_number<double>(node);
  if (value && std::isfinite(*value) && *value >= range.min && *value <= range.max) return *value;
  complain_at(node, key,
              "expected a number" + unit_of(key) + shown(range) + ", found " + shown(node));
  return fallback;
}

double YamlMap::number(std::string_view key, double fallback, NumberRange range) {
  const YamlNode* const node = take(key);
  const double value = node == nullptr ? fallback : to_number(*node, key, range, fallback);
  note(key, shown(value));
  return value;
}

double YamlMap::required_number(std::string_view key, NumberRange range) {
  return take_required(key) == nullptr ? 0.0 : number(key, 0.0, range);
}

int YamlMap::integer(std::string_view key, int fallback, int min, int max) {
  const YamlNode* const node = take(key);
  note(key, std::to_string(fallback));
  if (node == nullptr) return fallback;
  const auto value = parse_number<int>(*node);
  if (value && *value >= min && *value <= max) {
    note(key, std::to_string(*value));
    return *value;
  }
  const NumberRange range{
      min == std::numeric_limits<int>::min() ? -std::numeric_limits<double>::infinity() : min,
      max == std::numeric_limits<int>::max() ? std::numeric_limits<double>::infinity() : max};
  complain_at(*node, key, "expected a whole number" + shown(range) + ", found " + shown(*node));
  return fallback;
}

int YamlMap::required_integer(std::string_view key, int min, int max) {
  return take_required(key) == nullptr ? 0 : integer(key, 0, min, max);
}

bool YamlMap::boolean(std::string_view key, bool fallback) {
  const YamlNode* const node = take(key);
  note(key, fallback ? "true" : "false");
  if (node == nullptr) return fallback;
  if (node->kind == Kind::kScalar && (node->scalar == "true" || node->scalar == "false")) {
    note(key, node->scalar);
    return node->scalar == "true";
  }
  complain_at(*node, key, "expected true or false, found " + shown(*node));
  return fallback;
}

std::string YamlMap::text(std::string_view key, std::string fallback) {
  const YamlNode* const node = take(key);
  note(key, json_text(node != nullptr ? node->scalar : fallback));
  if (node == nullptr) return fallback;
  if (node->kind == Kind::kScalar) return node->scalar;
  complain_at(*node, key, "expected text, found " + shown(*node));
  return fallback;
}

std::string YamlMap::required_text(std::string_view key) {
  return take_required(key) == nullptr ? std::string() : text(key, {});
}

std::string YamlMap::choice(std::string_view key, std::string fallback,
                            const std::vector<std::string>& choices) {
  const std::string value = text(key, fallback);
  std::string list;
  for (const std::string& candidate : choices) {
    if (value == candidate) return value;
    list += (list.empty() ? "" : ", ") + candidate;
  }
  if (has(key)) complain(key, "expected one of " + list + ", found '" + value + "'");
  return fallback;
}

std::vector<double> YamlMap::to_numbers(const YamlNode& node, std::string_view key,
                                        std::size_t count, NumberRange range,
                                        std::vector<double> fallback) {
  if (node.kind != Kind::kSequence || (count > 0 && node.items.size() != count)) {
    complain_at(node, key,
                "expected a sequence of " + (count > 0 ? std::to_string(count) + " " : "") +
                    "numbers" + unit_of(key) + ", found " + shown(node));
    return fallback;
  }
  std::vector<double> values;
  for (const auto& item : node.items) values.push_back(to_number(*item, key, range, 0.0));
  return values;
}

std::vector<double> YamlMap::numbers(std::string_view key, std::vector<double> fallback,
                                     std::size_t count, NumberRange range) {
  const YamlNode* const node = take(key);
  auto values = node == nullptr ? std::move(fallback)
                                : to_numbers(*node, key, count, range, std::move(fallback));
  note(key, json_list(values, [](double value) { return shown(value); }));
  return values;
}

std::vector<double> YamlMap::required_numbers(std::string_view key, std::size_t count,
                                              NumberRange range) {
  std::vector<double> zeros(count, 0.0);
  return take_required(key) == nullptr ? zeros : numbers(key, zeros, count, range);
}

std::vector<std::string> YamlMap::texts(std::string_view key, std::vector<std::string> fallback) {
  const YamlNode* const node = take(key);
  if (node == nullptr) return fallback;
  std::vector<std::string> values;
  bool right = node->kind == Kind::kSequence;
  for (const auto& item : node->items) {
    right = right && item->kind == Kind::kScalar;
    values.push_back(item->scalar);
  }
  if (right) {
    note(key, json_list(values, [](const std::string& value) { return json_text(value); }));
    return values;
  }
  complain_at(*node, key, "expected a sequence of texts, found " + shown(*node));
  return fallback;
}

std::vector<std::string> YamlMap::text_or_texts(std::string_view key,
                                                std::vector<std::string> fallback) {
  if (!is_text(key)) return texts(key, std::move(fallback));
  return {text(key, {})};
}

YamlMap YamlMap::map(std::string_view key) {
  YamlNode* const node = take(key);
  if (node != nullptr && node->kind == Kind::kMap) return {document_, node, dotted(key)};
  if (node != nullptr) complain_at(*node, key, "expected a mapping, found " + shown(*node));
  auto absent = std::make_unique<YamlNode>();
  absent->kind = Kind::kMap;
  absent->line = node != nullptr ? node->line : node_->line;
  document_->absent.push_back(std::move(absent));
  return {document_, document_->absent.back().get(), dotted(key)};
}

YamlMap YamlMap::required_map(std::string_view key) {
  take_required(key);
  return map(key);
}

std::vector<YamlMap> YamlMap::maps(std::string_view key) {
  const YamlNode* const node = take(key);
  std::vector<YamlMap> values;
  if (node == nullptr) return values;
  bool right = node->kind == Kind::kSequence;
  for (const auto& item : node->items) {
    right = right && item->kind == Kind::kMap;
    if (right) {
      const std::string index = "." + std::to_string(values.size());
      values.push_back(YamlMap(document_, item.get(), dotted(key) + index));
    }
  }
  if (!right) complain_at(*node, key, "expected a sequence of mappings, found " + shown(*node));
  return values;
}

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : node_->entries) names.push_back(name);
  return names;
}

std::string YamlMap::where(std::string_view key) const {
  const YamlNode* const node = key.empty() ? nullptr : node_->find(key);
  return document_->place(node == nullptr ? *node_ : *node);
}

std::filesystem::path YamlMap::directory() const {
  return std::filesystem::path(document_->name).parent_path();
}

std::string YamlMap::dotted(std::string_view key) const {
  return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

void YamlMap::note(std::string_view key, const std::string& json) {
  const std::string name = dotted(key);
  for (auto& [known, value] : document_->used) {
    if (known == name) {
      value = json;
      return;
    }
  }
  document_->used.emplace_back(name, json);
}

std::string YamlMap::settings_json() const {
  std::string object;
  for (const auto& [key, value] : document_->used) {
    object += (object.empty() ? "" : ", ") + json_text(key) + ": " + value;
  }
  return "{" + object + "}";
}

Expected<void> YamlMap::finish() const {
  const auto complaint = document_->first_complaint();
  if (complaint) return fail(complaint->message);
  return {};
}

}  // namespace canopeer
