#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// Text of a file whatever program wrote it: without a byte order mark, as UTF-8, with lines that
/// end with a line feed, with or without a carriage return before it. UTF-16 is told by its mark.
/// `bytes` must outlive it.
class PlainText {
 public:
  explicit PlainText(std::string_view bytes);
  PlainText(const PlainText&) = delete;
  PlainText& operator=(const PlainText&) = delete;

  [[nodiscard]] std::string_view view() const { return view_; }
  /// No text holds a zero byte.
  [[nodiscard]] bool is_text() const { return view_.find('\0') == std::string_view::npos; }

 private:
  std::string converted_;
  std::string_view view_;
};

}  // namespace canopeer
