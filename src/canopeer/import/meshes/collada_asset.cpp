#include "canopeer/import/meshes/collada_asset.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace canopeer {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Comments become spaces, so that places stay where they are.
std::string without_comments(std::string_view text) {
  std::string plain(text);
  for (auto begin = plain.find("<!--"); begin != std::string::npos;
       begin = plain.find("<!--", begin)) {
    const auto end = plain.find("-->", begin);
    const auto stop = end == std::string::npos ? plain.size() : end + 3;
    std::replace_if(
        plain.begin() + static_cast<std::ptrdiff_t>(begin),
        plain.begin() + static_cast<std::ptrdiff_t>(stop), [](char c) { return c != '\n'; }, ' ');
  }
  return plain;
}

/// Where "<tag" begins as a whole word; npos: nowhere.
std::size_t find_tag(std::string_view text, std::string_view tag, std::size_t from = 0) {
  const std::string open = "<" + std::string(tag);
  for (auto at = text.find(open, from); at != std::string_view::npos;
       at = text.find(open, at + 1)) {
    const std::size_t next = at + open.size();
    if (next == text.size() || kSpace.find(text[next]) != std::string_view::npos ||
        text[next] == '>' || text[next] == '/') {
      return at;
    }
  }
  return std::string_view::npos;
}

/// The value of `attribute` in a start tag.
std::optional<std::string_view> attribute_of(std::string_view tag, std::string_view attribute) {
  for (auto at = tag.find(attribute); at != std::string_view::npos;
       at = tag.find(attribute, at + 1)) {
    if (at == 0 || kSpace.find(tag[at - 1]) == std::string_view::npos) continue;
    std::string_view rest = trimmed(tag.substr(at + attribute.size()));
    if (rest.empty() || rest.front() != '=') continue;
    rest = trimmed(rest.substr(1));
    if (rest.empty() || (rest.front() != '"' && rest.front() != '\'')) continue;
    const auto end = rest.find(rest.front(), 1);
    if (end == std::string_view::npos) return std::nullopt;
    return rest.substr(1, end - 1);
  }
  return std::nullopt;
}

std::string place(const std::string& name, std::string_view text, std::size_t at) {
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return name + ":" + std::to_string(line) + ": ";
}

std::optional<double> positive(std::string_view text) {
  text = trimmed(text);
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  // Between an atom and a planet: all else is no unit.
  if (!(value >= 1e-10 && value <= 1e7)) return std::nullopt;
  return value;
}

}  // namespace

Expected<ColladaAsset> parse_collada_asset(std::string_view text, const std::string& name) {
  // The first <asset> is the document's; it stands before all that is big.
  const auto close = text.find("</asset>");
  const std::string head = without_comments(text.substr(0, std::min(close, std::size_t{1} << 20)));
  ColladaAsset asset;
  const auto begin = find_tag(head, "asset");
  if (begin == std::string::npos) return asset;
  if (const auto unit = find_tag(head, "unit", begin); unit != std::string::npos) {
    const std::string_view tag = std::string_view(head).substr(unit, head.find('>', unit) - unit);
    if (const auto meter = attribute_of(tag, "meter")) {
      const auto value = positive(*meter);
      if (!value) {
        return fail(place(name, head, unit) + "<unit meter=\"" + std::string(*meter) +
                    "\">: expected a positive number of metres");
      }
      asset.unit_m = *value;
    }
  }
  if (const auto up = find_tag(head, "up_axis", begin); up != std::string::npos) {
    const auto from = std::min(head.find('>', up), head.size() - 1) + 1;
    const std::string_view axis =
        trimmed(std::string_view(head).substr(from, head.find('<', from) - from));
    if (axis != "X_UP" && axis != "Y_UP" && axis != "Z_UP") {
      return fail(place(name, head, up) + "<up_axis>" + std::string(axis.substr(0, 40)) +
                  ": expected X_UP, Y_UP or Z_UP");
    }
    asset.up = axis == "X_UP" ? UpAxis::x : axis == "Y_UP" ? UpAxis::y : UpAxis::z;
  }
  return asset;
}

}  // namespace canopeer
