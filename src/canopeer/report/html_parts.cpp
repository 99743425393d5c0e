#include "canopeer/report/html_parts.h"

#include <fmt/format.h>

#include "canopeer/report/drawing/page_style.h"
#include "canopeer/report/drawing/plot_style.h"
#include "canopeer/report/html_text.h"

namespace canopeer {

std::string html_section(const std::string& title, const std::string& content) {
  if (content.empty()) return {};
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape_html(title), content);
}

std::string html_plot(const SvgPlot& plot, int wide_height_px, int narrow_height_px) {
  constexpr int kWidePx = 880;
  constexpr int kNarrowPx = 340;
  return fmt::format("<div class=\"wide\">{}</div>\n<div class=\"narrow\">{}</div>\n",
                     plot.svg(kWidePx, wide_height_px), plot.svg(kNarrowPx, narrow_height_px));
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const std::string& cell : head) html += "<th scope=\"col\">" + cell + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_details(const std::string& summary, const std::string& content) {
  return fmt::format("<details>\n<summary>{}</summary>\n{}</details>\n", escape_html(summary),
                     content);
}

std::string html_moment(double t_s, const std::string& html) {
  return fmt::format("<a href=\"http://127.0.0.1:8765/#t={:.2f}\">{}</a>", t_s, html);
}

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}{}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n"
      "</html>\n",
      escape_html(title), plot_style(), page_style(), body);
}

}  // namespace canopeer
