#include "canopeer/report/run_files.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/csv_table.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/record/record_file.h"
#include "canopeer/report/reading/killed_run.h"

namespace canopeer {
namespace {

bool is_there(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::exists(path, code);
}

Expected<Ripeness> ripeness_of(const std::string& name) {
  if (name == "green") return Ripeness::green;
  if (name == "turning") return Ripeness::turning;
  if (name == "ripe") return Ripeness::ripe;
  return fail("class '" + name + "', expected green, turning or ripe");
}

Expected<FruitTruth> truth_of(const CsvTable& table, std::size_t row) {
  FruitTruth fruit;
  const Expected<std::string> name = table.text(row, "class");
  if (!name) return fail(name.error().message);
  const Expected<Ripeness> ripeness = ripeness_of(*name);
  if (!ripeness) return fail(ripeness.error().message);
  fruit.ripeness = *ripeness;
  int counted = 0;
  // Imported worlds name models, not plants, and have volumes of hulls.
  const bool imported = table.has("hull_volume_cm3");
  const char* const volume = imported ? "hull_volume_cm3" : "volume_cm3";
  std::vector<std::pair<const char*, int*>> integers = {{"id", &fruit.id}, {"counted", &counted}};
  if (!imported) integers.emplace_back("plant", &fruit.plant);
  for (const auto& [column, value] : integers) {
    const Expected<int> field = table.integer(row, column);
    if (!field) return fail(field.error().message);
    *value = *field;
  }
  fruit.counted = counted != 0;
  for (const auto& [column, value] :
       {std::pair{"x_m", &fruit.centre.x()}, std::pair{"y_m", &fruit.centre.y()},
        std::pair{"z_m", &fruit.centre.z()}, std::pair{"length_m", &fruit.length_m},
        std::pair{"diameter_m", &fruit.diameter_m}, std::pair{volume, &fruit.volume_cm3},
        std::pair{"surface_cm2", &fruit.surface_cm2}}) {
    const Expected<double> field = table.number(row, column);
    if (!field) return fail(field.error().message);
    *value = *field;
  }
  return fruit;
}

Expected<std::vector<FruitTruth>> read_truth(const std::filesystem::path& path) {
  const Expected<CsvTable> table = CsvTable::read(path);
  if (!table) return fail(table.error().message);
  std::vector<FruitTruth> truth;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const Expected<FruitTruth> fruit = truth_of(*table, row);
    if (!fruit) return fail(fruit.error().message);
    truth.push_back(*fruit);
  }
  return truth;
}

std::string caption_of(std::string stem) {
  const std::size_t name = stem.find_first_not_of("0123456789_- ");
  if (name != std::string::npos) stem.erase(0, name);
  std::replace(stem.begin(), stem.end(), '_', ' ');
  if (!stem.empty()) {
    stem[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(stem[0])));
  }
  return stem;
}

Expected<std::vector<ReportPicture>> read_pictures(const std::filesystem::path& dir) {
  std::vector<std::filesystem::path> paths;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(dir, code)) {
    if (entry.path().extension() == ".png") paths.push_back(entry.path());
  }
  if (code) return fail(dir.string() + ": cannot read: " + code.message());
  std::sort(paths.begin(), paths.end());
  std::vector<ReportPicture> pictures;
  for (const std::filesystem::path& path : paths) {
    Expected<std::string> bytes = read_file(path);
    if (!bytes) return fail(bytes.error().message);
    pictures.push_back({caption_of(path.stem().string()), std::move(*bytes)});
  }
  return pictures;
}

/// Moves a value that was read into its place, or gives the error on.
template <typename T>
Expected<void> into(T& place, Expected<T> read) {
  if (!read) return fail(read.error().message);
  place = std::move(*read);
  return {};
}

}  // namespace

Expected<RunFiles> read_run_files(const std::filesystem::path& run_dir) {
  RunFiles files;
  Expected<void> read = into(files.record, read_record(run_dir / "record"));
  if (read) {
    read = is_there(run_dir / "summary.json")
               ? into(files.summary, read_summary(run_dir / "summary.json"))
               : into<Summary>(files.summary, summary_from_record(files.record));
  }
  if (read) {
    read = is_there(run_dir / "fruits.csv")
               ? into(files.fruits, read_fruits_csv(run_dir / "fruits.csv"))
               : into<std::vector<FruitEstimate>>(files.fruits, fruits_from_record(files.record));
  }
  if (read && is_there(run_dir / "fruits.ply")) {
    read = into(files.surface, read_cloud(run_dir / "fruits.ply"));
  }
  if (read && is_there(run_dir / "ground_truth.csv")) {
    read = into(files.truth, read_truth(run_dir / "ground_truth.csv"));
  }
  if (read && is_there(run_dir / "pictures")) {
    read = into(files.pictures, read_pictures(run_dir / "pictures"));
  }
  if (!read) return fail(read.error().message);
  files.replay = is_there(run_dir / "replay");
  return files;
}

}  // namespace canopeer
