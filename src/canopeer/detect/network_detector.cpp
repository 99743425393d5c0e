#include "canopeer/detect/network_detector.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "canopeer/base/check.h"

namespace canopeer {

struct NetworkDetector::Network {
  NetworkDetectorOptions options;
  cv::dnn::Net net;
  std::mutex busy;  // a network runs one image at a time

  Expected<cv::Mat> scores(const ColorImage& color);
};

namespace {

/// OpenCV's message without its source file and function.
std::string reason(const cv::Exception& error) {
  return error.err.empty() ? std::string(error.what()) : error.err;
}

std::string shape_of(const cv::Mat& m) {
  std::string text;
  for (int i = 0; i < m.dims; ++i) text += (i ? " x " : "") + std::to_string(m.size[i]);
  return text;
}

/// Of the classes at one place: the best and its probability.
std::pair<int, float> best_class(const cv::Mat& scores, int row, int column, bool softmax) {
  const int classes = scores.size[1];
  int best = 0;
  const auto score = [&](int c) {
    const int index[4] = {0, c, row, column};
    return scores.at<float>(index);
  };
  for (int c = 1; c < classes; ++c) {
    if (score(c) > score(best)) best = c;
  }
  if (!softmax) return {best, score(best)};
  float sum = 0.0F;
  for (int c = 0; c < classes; ++c) sum += std::exp(score(c) - score(best));
  return {best, 1.0F / sum};
}

}  // namespace

Expected<cv::Mat> NetworkDetector::Network::scores(const ColorImage& color) {
  static_assert(sizeof(Rgb) == 3);
  const cv::Mat rgb(color.height(), color.width(), CV_8UC3,
                    const_cast<Rgb*>(color.pixels().data()));
  try {
    const auto& mean = options.mean;
    // The mean is in the order of the channels after the swap.
    const cv::Scalar in_order =
        options.bgr ? cv::Scalar(mean[2], mean[1], mean[0]) : cv::Scalar(mean[0], mean[1], mean[2]);
    const cv::Mat input = cv::dnn::blobFromImage(
        rgb, options.scale, cv::Size(options.input_width_px, options.input_height_px), in_order,
        options.bgr, false, CV_32F);
    const std::lock_guard lock(busy);
    net.setInput(input);
    return net.forward().clone();
  } catch (const cv::Exception& error) {
    return fail(options.model.string() + ": the network cannot take an input of 1 x 3 x " +
                std::to_string(options.input_height_px) + " x " +
                std::to_string(options.input_width_px) + ": " + reason(error));
  }
}

NetworkDetector::NetworkDetector(std::unique_ptr<Network> network) : network_(std::move(network)) {}
NetworkDetector::~NetworkDetector() = default;

Expected<std::unique_ptr<NetworkDetector>> NetworkDetector::make(
    const NetworkDetectorOptions& options) {
  if (auto ok = options.validate(); !ok) return tl::unexpected(ok.error());
  std::error_code code;
  if (!std::filesystem::is_regular_file(options.model, code)) {
    return fail(options.model.string() + ": no such model file");
  }
  auto network = std::make_unique<Network>();
  network->options = options;
  try {
    network->net = cv::dnn::readNetFromONNX(options.model.string());
    network->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    network->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const cv::Exception& error) {
    return fail(options.model.string() + ": not an ONNX model that can be read: " + reason(error));
  }
  if (network->net.empty()) return fail(options.model.string() + ": holds no network");
  const auto trial = network->scores(ColorImage(options.input_width_px, options.input_height_px));
  if (!trial) return tl::unexpected(trial.error());
  const int classes = static_cast<int>(options.classes.size());
  if (trial->dims != 4 || trial->size[0] != 1 || trial->size[1] != classes ||
      trial->type() != CV_32F) {
    return fail(options.model.string() + ": gives an output of " + shape_of(*trial) +
                ", expected 1 x " + std::to_string(classes) +
                " x height x width: one channel for each of the classes");
  }
  return std::unique_ptr<NetworkDetector>(new NetworkDetector(std::move(network)));
}

Expected<Detection> NetworkDetector::detect(const RgbdFrame& frame) const {
  const int width = frame.color.width();
  const int height = frame.color.height();
  CANOPEER_CHECK(width == frame.depth.width() && height == frame.depth.height(),
                 "registered colour and depth images");
  Detection detection{Image<PixelLabel>(width, height), Mask(width, height),
                      Image<float>(width, height)};
  if (frame.color.empty()) return detection;
  const auto scores = network_->scores(frame.color);
  if (!scores) return tl::unexpected(scores.error());
  const NetworkDetectorOptions& o = network_->options;
  const int rows = scores->size[2];
  const int columns = scores->size[3];
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (!(frame.depth.at(u, v) > 0.0F)) continue;
      const auto [best, probability] =
          best_class(*scores, v * rows / height, u * columns / width, o.softmax);
      const PixelLabel label = o.classes[static_cast<std::size_t>(best)];
      if (label == PixelLabel::background || probability < static_cast<float>(o.min_confidence)) {
        continue;
      }
      detection.label.at(u, v) = label;
      detection.confidence.at(u, v) = std::min(probability, 1.0F);
      if (counted_fruit(label)) detection.fruit.at(u, v) = static_cast<std::uint8_t>(label);
    }
  }
  return detection;
}

Expected<void> NetworkDetectorOptions::validate() const {
  if (model.empty()) return fail("model: expected the path of an ONNX file");
  // In less than 32 pixels a whole view fits, but no fruit.
  if (input_width_px < 32 || input_height_px < 32 || input_width_px > 8192 ||
      input_height_px > 8192) {
    return fail("input_width_px and input_height_px must be in 32..8192");
  }
  if (!(scale > 0.0)) return fail("scale must be positive");
  if (mean.size() != 3) return fail("mean: expected three numbers");
  if (classes.size() < 2) return fail("classes: expected at least two");
  if (min_confidence < 0.0 || min_confidence > 1.0) return fail("min_confidence must be in 0..1");
  return {};
}

}  // namespace canopeer
