#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/cdr/messages/builtin_interfaces.h"

// Humble and Jazzy have the same layout.

namespace canopeer::ros::rcl_interfaces {

struct Log {
  static constexpr std::string_view kType = "rcl_interfaces/msg/Log";
  static constexpr std::uint8_t DEBUG = 10;
  static constexpr std::uint8_t INFO = 20;
  static constexpr std::uint8_t WARN = 30;
  static constexpr std::uint8_t ERROR = 40;
  static constexpr std::uint8_t FATAL = 50;
  builtin_interfaces::Time stamp;
  std::uint8_t level{};
  std::string name;
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(stamp, level, name, msg, file, function, line);
  }
};

/// Which member of a ParameterValue counts.
struct ParameterType {
  static constexpr std::uint8_t PARAMETER_NOT_SET = 0;
  static constexpr std::uint8_t PARAMETER_BOOL = 1;
  static constexpr std::uint8_t PARAMETER_INTEGER = 2;
  static constexpr std::uint8_t PARAMETER_DOUBLE = 3;
  static constexpr std::uint8_t PARAMETER_STRING = 4;
  static constexpr std::uint8_t PARAMETER_BYTE_ARRAY = 5;
  static constexpr std::uint8_t PARAMETER_BOOL_ARRAY = 6;
  static constexpr std::uint8_t PARAMETER_INTEGER_ARRAY = 7;
  static constexpr std::uint8_t PARAMETER_DOUBLE_ARRAY = 8;
  static constexpr std::uint8_t PARAMETER_STRING_ARRAY = 9;
};

struct ParameterValue {
  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterValue";
  std::uint8_t type{};
  bool bool_value{};
  std::int64_t integer_value{};
  double double_value{};
  std::string string_value;
  std::vector<std::uint8_t> byte_array_value;
  std::vector<bool> bool_array_value;
  std::vector<std::int64_t> integer_array_value;
  std::vector<double> double_array_value;
  std::vector<std::string> string_array_value;
  template <class Archive>
  void visit(Archive& archive) {
    archive(type, bool_value, integer_value, double_value, string_value, byte_array_value,
            bool_array_value, integer_array_value, double_array_value, string_array_value);
  }
};

struct Parameter {
  static constexpr std::string_view kType = "rcl_interfaces/msg/Parameter";
  std::string name;
  ParameterValue value;
  template <class Archive>
  void visit(Archive& archive) {
    archive(name, value);
  }
};

struct FloatingPointRange {
  static constexpr std::string_view kType = "rcl_interfaces/msg/FloatingPointRange";
  double from_value{}, to_value{}, step{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(from_value, to_value, step);
  }
};

struct IntegerRange {
  static constexpr std::string_view kType = "rcl_interfaces/msg/IntegerRange";
  std::int64_t from_value{}, to_value{};
  std::uint64_t step{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(from_value, to_value, step);
  }
};

/// At most one range of each kind.
struct ParameterDescriptor {
  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterDescriptor";
  std::string name;
  std::uint8_t type{};
  std::string description;
  std::string additional_constraints;
  bool read_only{};
  bool dynamic_typing{};
  std::vector<FloatingPointRange> floating_point_range;
  std::vector<IntegerRange> integer_range;
  template <class Archive>
  void visit(Archive& archive) {
    archive(name, type, description, additional_constraints, read_only, dynamic_typing,
            floating_point_range, integer_range);
  }
};

struct ListParametersResult {
  static constexpr std::string_view kType = "rcl_interfaces/msg/ListParametersResult";
  std::vector<std::string> names;
  std::vector<std::string> prefixes;
  template <class Archive>
  void visit(Archive& archive) {
    archive(names, prefixes);
  }
};

struct SetParametersResult {
  static constexpr std::string_view kType = "rcl_interfaces/msg/SetParametersResult";
  bool successful{};
  std::string reason;
  template <class Archive>
  void visit(Archive& archive) {
    archive(successful, reason);
  }
};

struct ParameterEvent {
  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterEvent";
  builtin_interfaces::Time stamp;
  std::string node;
  std::vector<Parameter> new_parameters;
  std::vector<Parameter> changed_parameters;
  std::vector<Parameter> deleted_parameters;
  template <class Archive>
  void visit(Archive& archive) {
    archive(stamp, node, new_parameters, changed_parameters, deleted_parameters);
  }
};

struct GetParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameters";
  struct Request {
    std::vector<std::string> names;
    template <class Archive>
    void visit(Archive& archive) {
      archive(names);
    }
  };
  struct Response {
    std::vector<ParameterValue> values;
    template <class Archive>
    void visit(Archive& archive) {
      archive(values);
    }
  };
};

struct GetParameterTypes {
  static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameterTypes";
  struct Request {
    std::vector<std::string> names;
    template <class Archive>
    void visit(Archive& archive) {
      archive(names);
    }
  };
  struct Response {
    std::vector<std::uint8_t> types;
    template <class Archive>
    void visit(Archive& archive) {
      archive(types);
    }
  };
};

struct SetParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/SetParameters";
  struct Request {
    std::vector<Parameter> parameters;
    template <class Archive>
    void visit(Archive& archive) {
      archive(parameters);
    }
  };
  struct Response {
    std::vector<SetParametersResult> results;
    template <class Archive>
    void visit(Archive& archive) {
      archive(results);
    }
  };
};

struct SetParametersAtomically {
  static constexpr std::string_view kType = "rcl_interfaces/srv/SetParametersAtomically";
  struct Request {
    std::vector<Parameter> parameters;
    template <class Archive>
    void visit(Archive& archive) {
      archive(parameters);
    }
  };
  struct Response {
    SetParametersResult result;
    template <class Archive>
    void visit(Archive& archive) {
      archive(result);
    }
  };
};

struct ListParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/ListParameters";
  struct Request {
    static constexpr std::uint64_t DEPTH_RECURSIVE = 0;
    std::vector<std::string> prefixes;
    std::uint64_t depth{};
    template <class Archive>
    void visit(Archive& archive) {
      archive(prefixes, depth);
    }
  };
  struct Response {
    ListParametersResult result;
    template <class Archive>
    void visit(Archive& archive) {
      archive(result);
    }
  };
};

struct DescribeParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/DescribeParameters";
  struct Request {
    std::vector<std::string> names;
    template <class Archive>
    void visit(Archive& archive) {
      archive(names);
    }
  };
  struct Response {
    std::vector<ParameterDescriptor> descriptors;
    template <class Archive>
    void visit(Archive& archive) {
      archive(descriptors);
    }
  };
};

}  // namespace canopeer::ros::rcl_interfaces
