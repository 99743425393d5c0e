#include "canopeer/fruit/fruits_csv.h"

#include <fmt/format.h>

#include "canopeer/base/csv_table.h"

namespace canopeer {
namespace {

constexpr const char* kColumns =
    "id,x_m,y_m,z_m,a_m,b_m,c_m,e1,e2,roll_rad,pitch_rad,yaw_rad,volume_cm3,points,confidence,"
    "sd_x_m,sd_y_m,sd_z_m,volume_sd_cm3,rms_m,seen_share,ripeness,red,green,blue,views,"
    "first_seen_s,last_seen_s,row,side,along_m,height_m\n";

/// Reads the fields of one row; keeps the first error. Columns that came later may be missing.
class RowReader {
 public:
  RowReader(const CsvTable& table, std::size_t row) : table_(table), row_(row) {}

  double number(const char* column) { return checked(table_.number(row_, column)); }
  int integer(const char* column) { return checked(table_.integer(row_, column)); }
  std::string text(const char* column) { return checked(table_.text(row_, column)); }
  [[nodiscard]] bool has(const char* column) const { return table_.has(column); }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  template <typename T>
  T checked(const Expected<T>& value) {
    if (value) return *value;
    if (!error_) error_ = value.error();
    return T{};
  }
  const CsvTable& table_;
  std::size_t row_;
  std::optional<Error> error_;
};

PixelLabel class_named(const std::string& name) {
  for (const PixelLabel c :
       {PixelLabel::green_fruit, PixelLabel::turning_fruit, PixelLabel::ripe_fruit}) {
    if (name == ripeness_name(c)) return c;
  }
  return PixelLabel::background;
}

void read_later_columns(RowReader& row, FruitEstimate& f) {
  f.centre_sd_m = {row.number("sd_x_m"), row.number("sd_y_m"), row.number("sd_z_m")};
  f.volume_sd_cm3 = row.number("volume_sd_cm3");
  f.rms_m = row.number("rms_m");
  f.seen_share = row.number("seen_share");
  f.ripeness = class_named(row.text("ripeness"));
  const auto channel = [&](const char* column) {
    return static_cast<std::uint8_t>(row.integer(column));
  };
  f.color = {channel("red"), channel("green"), channel("blue")};
  f.views = row.integer("views");
  f.first_seen_s = row.number("first_seen_s");
  f.last_seen_s = row.number("last_seen_s");
  const std::string name = row.text("row");
  if (name.empty()) return;
  const std::string side = row.text("side");
  f.place =
      RowPlace{name, side.empty() ? 'L' : side[0], row.number("along_m"), row.number("height_m")};
}

FruitEstimate fruit_from(RowReader& row) {
  FruitEstimate fruit;
  fruit.id = row.integer("id");
  fruit.centre = {row.number("x_m"), row.number("y_m"), row.number("z_m")};
  fruit.semi_axes_m = {row.number("a_m"), row.number("b_m"), row.number("c_m")};
  fruit.e1 = row.number("e1");
  fruit.e2 = row.number("e2");
  fruit.roll_pitch_yaw_rad = {row.number("roll_rad"), row.number("pitch_rad"),
                              row.number("yaw_rad")};
  fruit.volume_cm3 = row.number("volume_cm3");
  fruit.points = row.integer("points");
  fruit.confidence = row.number("confidence");
  if (row.has("sd_x_m")) read_later_columns(row, fruit);
  return fruit;
}

}  // namespace

std::string fruits_csv(const std::vector<FruitEstimate>& fruits) {
  std::string csv = kColumns;
  for (const FruitEstimate& f : fruits) {
    csv += fmt::format(
        "{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.1f},{},"
        "{:.3f},",
        f.id, f.centre.x(), f.centre.y(), f.centre.z(), f.semi_axes_m.x(), f.semi_axes_m.y(),
        f.semi_axes_m.z(), f.e1, f.e2, f.roll_pitch_yaw_rad.x(), f.roll_pitch_yaw_rad.y(),
        f.roll_pitch_yaw_rad.z(), f.volume_cm3, f.points, f.confidence);
    csv += fmt::format("{:.4f},{:.4f},{:.4f},{:.1f},{:.4f},{:.3f},{},{},{},{},{},{:.2f},{:.2f},",
                       f.centre_sd_m.x(), f.centre_sd_m.y(), f.centre_sd_m.z(), f.volume_sd_cm3,
                       f.rms_m, f.seen_share, ripeness_name(f.ripeness), f.color.r, f.color.g,
                       f.color.b, f.views, f.first_seen_s, f.last_seen_s);
    csv += f.place ? fmt::format("{},{},{:.3f},{:.3f}\n", f.place->row, f.place->side,
                                 f.place->along_m, f.place->height_m)
                   : ",,,\n";
  }
  return csv;
}

Expected<std::vector<FruitEstimate>> read_fruits_csv(const std::filesystem::path& path) {
  const Expected<CsvTable> table = CsvTable::read(path);
  if (!table) return fail(table.error().message);
  std::vector<FruitEstimate> fruits;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    RowReader row(*table, i);
    fruits.push_back(fruit_from(row));
    if (row.error()) return fail(row.error()->message);
  }
  return fruits;
}

}  // namespace canopeer
