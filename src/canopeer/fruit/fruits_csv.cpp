#include "canopeer/fruit/fruits_csv.h"

#include <fmt/format.h>

#include "canopeer/base/csv_table.h"

namespace canopeer {
namespace {

/// Reads the fields of one row; keeps the first error.
class RowReader {
 public:
  RowReader(const CsvTable& table, std::size_t row) : table_(table), row_(row) {}

  double number(const char* column) { return checked(table_.number(row_, column)); }
  int integer(const char* column) { return checked(table_.integer(row_, column)); }
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
  return fruit;
}

}  // namespace

std::string fruits_csv(const std::vector<FruitEstimate>& fruits) {
  std::string csv =
      "id,x_m,y_m,z_m,a_m,b_m,c_m,e1,e2,roll_rad,pitch_rad,yaw_rad,volume_cm3,points,"
      "confidence\n";
  for (const FruitEstimate& f : fruits) {
    csv += fmt::format(
        "{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.1f},{},"
        "{:.3f}\n",
        f.id, f.centre.x(), f.centre.y(), f.centre.z(), f.semi_axes_m.x(), f.semi_axes_m.y(),
        f.semi_axes_m.z(), f.e1, f.e2, f.roll_pitch_yaw_rad.x(), f.roll_pitch_yaw_rad.y(),
        f.roll_pitch_yaw_rad.z(), f.volume_cm3, f.points, f.confidence);
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
