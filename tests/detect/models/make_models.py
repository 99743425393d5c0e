#!/usr/bin/python3
"""Makes the tiny models of the network detector's tests (needs python3-onnx, opset 11).

colour_rule.onnx: 1 x 3 x 240 x 320 RGB in 0 ... 1 to scores of background, turning, ripe: a 1 x 1
convolution whose weights tell the simulated colours apart, whatever the brightness.
four_channels.onnx: the same for images with four channels, which cameras here do not give.
"""
import numpy as np
from onnx import TensorProto, checker, helper, numpy_helper, save

WEIGHTS = np.array([[-15.0, 30.0, 0.0], [-3.0, 20.0, -30.0], [10.0, -33.0, 0.0]], np.float32)


def model(weights, name):
    channels = weights.shape[1]
    kernel = numpy_helper.from_array(weights.reshape(3, channels, 1, 1), "weights")
    node = helper.make_node("Conv", ["image", "weights"], ["scores"], kernel_shape=[1, 1])
    image = helper.make_tensor_value_info("image", TensorProto.FLOAT, [1, channels, 240, 320])
    scores = helper.make_tensor_value_info("scores", TensorProto.FLOAT, [1, 3, 240, 320])
    graph = helper.make_graph([node], name, [image], [scores], [kernel])
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 11)])
    made.ir_version = 6
    checker.check_model(made)
    save(made, name + ".onnx")


model(WEIGHTS, "colour_rule")
model(np.hstack([WEIGHTS, np.zeros((3, 1), np.float32)]), "four_channels")
