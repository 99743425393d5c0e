#include "canopeer/report/report.h"

#include "canopeer/base/atomic_file.h"
#include "canopeer/report/fruits/fruit_map_svg.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

ReportData report_data(RunFiles files) {
  ReportData data;
  data.verdicts = fruit_verdicts(files.fruits, files.truth);
  if (!files.truth.empty()) {
    data.found = compute_metrics(files.record, files.fruits, files.truth).found;
  }
  data.files = std::move(files);
  return data;
}

}  // namespace

Expected<void> write_report(const std::filesystem::path& run_dir) {
  Expected<RunFiles> files = read_run_files(run_dir);
  if (!files) return fail(files.error().message);
  const ReportData data = report_data(std::move(*files));

  std::string body;
  for (const auto section :
       {headline_section, progress_section, map_section, gallery_section, view_interval_section,
        frames_section, time_use_section, picture_section, segment_section, figures_section,
        fruit_list_section, settings_section}) {
    body += section(data);
  }
  const std::string title = "canopeer: " + data.files.summary.mission;
  if (auto written = write_file(run_dir / "report.html", html_page(title, body)); !written) {
    return written;
  }
  constexpr int kMapWidthPx = 880;
  return write_file(run_dir / "fruit_map.svg",
                    fruit_map_svg(fruit_map_input(data.files), kMapWidthPx, true));
}

}  // namespace canopeer
