#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/detect/detector.h"

namespace canopeer {

/// The network, and how its input and output are to be read.
struct NetworkDetectorOptions {
  std::filesystem::path model;  ///< ONNX file
  int input_width_px = 640;     ///< images are scaled to what the model was made for
  int input_height_px = 480;
  double scale = 1.0 / 255.0;                  ///< input = (pixel − mean) · scale
  std::vector<double> mean = {0.0, 0.0, 0.0};  ///< red, green, blue, grey levels
  bool bgr = false;                            ///< the model wants blue first
  /// What the model's classes mean, in the order of its output channels.
  std::vector<PixelLabel> classes = {PixelLabel::background, PixelLabel::turning_fruit,
                                     PixelLabel::ripe_fruit};
  bool softmax = true;          ///< outputs are scores; false: they are probabilities already
  double min_confidence = 0.5;  ///< less sure pixels are background

  [[nodiscard]] Expected<void> validate() const;
};

/// Fruit by a segmentation network: one input 1 × 3 × H × W, one output 1 × C × h × w of scores by
/// class (h × w may be coarser), run by OpenCV on the CPU.
class NetworkDetector final : public Detector {
 public:
  /// Reads the model and tries it once, so that what is wrong with it is said here: no such file,
  /// no ONNX model, an output that does not fit `classes`.
  [[nodiscard]] static Expected<std::unique_ptr<NetworkDetector>> make(
      const NetworkDetectorOptions& options);
  ~NetworkDetector() override;
  [[nodiscard]] Expected<Detection> detect(const RgbdFrame& frame) const override;

 private:
  struct Network;
  explicit NetworkDetector(std::unique_ptr<Network> network);
  std::unique_ptr<Network> network_;
};

}  // namespace canopeer
