#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace canopeer {

/// Bytes of a file to be, in pages: growing moves none and takes no more than they need.
class PagedBytes {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  char& operator[](std::size_t i) { return pages_[i / kPage][i % kPage]; }
  /// Appends zeros, or drops bytes at the end.
  void resize(std::size_t size) {
    const std::size_t pages = (size + kPage - 1) / kPage;
    while (pages_.size() < pages) pages_.emplace_back(kPage, '\0');
    pages_.resize(pages);
    for (std::size_t i = size_; i < size; ++i) (*this)[i] = '\0';
    size_ = size;
  }
  /// Valid until the next change.
  [[nodiscard]] std::vector<std::string_view> pieces() const {
    std::vector<std::string_view> pieces;
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      pieces.push_back(std::string_view(pages_[i]).substr(0, std::min(kPage, size_ - i * kPage)));
    }
    return pieces;
  }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 20;
  std::vector<std::string> pages_;
  std::size_t size_ = 0;
};

}  // namespace canopeer
