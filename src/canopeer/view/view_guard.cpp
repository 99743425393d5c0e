#include "canopeer/view/view_guard.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace canopeer {
namespace {

std::string_view query_value(std::string_view target, std::string_view name) {
  const std::size_t question = target.find('?');
  if (question == std::string_view::npos) return {};
  std::string_view query = target.substr(question + 1);
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (pair.starts_with(name) && pair.substr(name.size()).starts_with('='))
      return pair.substr(name.size() + 1);
  }
  return {};
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// "192.168.1.5", not a name that somebody's DNS may bend.
bool is_ipv4(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

ViewGuard::ViewGuard(std::string address, std::uint16_t port, std::string_view host_name,
                     std::string token)
    : address_(std::move(address)),
      port_(std::to_string(port)),
      host_name_(lower_case(host_name)),
      token_(std::move(token)) {}

bool ViewGuard::loopback() const { return address_.starts_with("127.") || address_ == "::1"; }

bool ViewGuard::knows_host(std::string_view given) const {
  const std::string lower = lower_case(given);
  const std::string_view host = lower;
  const std::size_t colon = host.rfind(':');
  const bool bracketed = host.starts_with('[');
  std::string_view name = host;
  std::string_view port = "80";
  if (colon != std::string_view::npos && (!bracketed || host[colon - 1] == ']')) {
    name = host.substr(0, colon);
    port = host.substr(colon + 1);
  }
  if (port.empty() || port.find_first_not_of("0123456789") != std::string_view::npos) return false;
  // A tunnel from another machine may end at another port there.
  if (name == "localhost" || name == "[::1]" || name == "127.0.0.1") return true;
  if (port != port_) return false;
  return name == address_ || (!loopback() && (is_ipv4(name) || bracketed || name == host_name_ ||
                                              name == host_name_ + ".local"));
}

bool ViewGuard::knows_origin(std::optional<std::string_view> origin, std::string_view host) const {
  if (!origin) return true;
  constexpr std::string_view kScheme = "http://";
  return origin->starts_with(kScheme) && origin->substr(kScheme.size()) == host;
}

bool ViewGuard::has_token(std::string_view target) const {
  const std::string_view given = query_value(target, "token");
  unsigned difference = token_.empty() || given.size() != token_.size() ? 1 : 0;
  for (std::size_t i = 0; i < token_.size(); ++i) {
    const char other = i < given.size() ? given[i] : '\0';
    difference |= static_cast<unsigned>(static_cast<unsigned char>(token_[i] ^ other));
  }
  return difference == 0;
}

}  // namespace canopeer
