// What most files include, and takes the compiler longest to read (CANOPEER_UNITY_BUILD). Only headers of the system:
// they change with it alone, so that the compiler cache stays good.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>
#include <unordered_map>
#include <utility>
#include <vector>
