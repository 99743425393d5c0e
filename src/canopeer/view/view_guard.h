#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace canopeer {

/// Who may look at a run over HTTP, and who may steer it. A page of another site that is open in
/// the same browser can send requests here too: its origin, or a name that was bent to this
/// address, gives it away.
class ViewGuard {
 public:
  /// `address` and `port`: where the server listens; `host_name`: this machine's.
  ViewGuard(std::string address, std::uint16_t port, std::string_view host_name, std::string token);

  /// Whether "Host" names this server: an address, this machine's name, localhost.
  [[nodiscard]] bool knows_host(std::string_view host) const;
  /// Whether "Origin" is a page of this server's, or of no browser (none).
  [[nodiscard]] bool knows_origin(std::optional<std::string_view> origin,
                                  std::string_view host) const;
  /// Whether the "token" of a target's query is the right one; takes the same time for any.
  [[nodiscard]] bool has_token(std::string_view target) const;
  [[nodiscard]] bool may_look(std::string_view target) const {
    return loopback() || has_token(target);
  }
  /// Nobody on other machines reaches it.
  [[nodiscard]] bool loopback() const;

 private:
  std::string address_;
  std::string port_;
  std::string host_name_;
  std::string token_;
};

/// A target's path, up to the query.
[[nodiscard]] std::string_view path_of(std::string_view target);

}  // namespace canopeer
