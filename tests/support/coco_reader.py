"""Reads a run's folder as loaders of COCO do and compares with its planes, in plain Python.

python3 coco_reader.py FOLDER

Nothing of diurna's is used: annotations.json as pycocotools indexes it (uncompressed run lengths down the columns,
first the pixels outside; iscrowd; categories by id), planes from the EXR files by their layout (OpenEXR file layout,
uncompressed scan lines), pictures from PNG by zlib. Average precision is that of the COCO evaluation (Lin et al.
2014): IoU 0.50 to 0.95, 101 recalls, crowds ignored.

Prints NAME VALUE a line: what was counted, how many disagree, average precisions.
"""
import json
import os
import struct
import sys
import zlib


def read_exr(path):
    """{"width", "height", plane: [row by row]} of 32-bit floats."""
    data = open(path, "rb").read()
    magic, at = struct.unpack_from("<i", data)[0], 8
    assert magic == 20000630, "no EXR"

    def text(at):
        end = data.index(b"\0", at)
        return data[at:end].decode(), end + 1

    channels, window, packed = [], None, None
    while data[at] != 0:
        name, at = text(at)
        _, at = text(at)
        size = struct.unpack_from("<i", data, at)[0]
        value, at = at + 4, at + 4 + size
        if name == "channels":
            while data[value] != 0:
                channel, value = text(value)
                assert struct.unpack_from("<i", data, value)[0] == 2, "no floats"
                channels.append(channel)
                value += 16
        elif name == "dataWindow":
            window = struct.unpack_from("<4i", data, value)
        elif name == "compression":
            packed = data[value]
    assert packed == 0, "packed"
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    planes = {c: [0.0] * (width * height) for c in channels}
    for offset in struct.unpack_from("<%dQ" % height, data, at + 1):
        row = struct.unpack_from("<i", data, offset)[0] - window[1]
        for k, c in enumerate(channels):
            planes[c][row * width:(row + 1) * width] = struct.unpack_from(
                "<%df" % width, data, offset + 8 + 4 * k * width)
    planes.update(width=width, height=height)
    return planes


def read_grey_png(path):
    """Width, height and numbers of a grey PNG of 8 or 16 bits, not interlaced."""
    data = open(path, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour, _, _, laced = struct.unpack(">IIBBBBB", body)
            assert colour == 0 and laced == 0 and bits in (8, 16), "no grey PNG"
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    lines, wide = zlib.decompress(packed), bits // 8
    stride = width * wide
    above, values = [0] * stride, []
    for row in range(height):
        start = row * (stride + 1)
        how, line = lines[start], list(lines[start + 1:start + 1 + stride])
        for i in range(stride):
            left = line[i - wide] if i >= wide else 0
            corner = above[i - wide] if i >= wide else 0
            if how == 4:  # Paeth
                guess = left + above[i] - corner
                away = [abs(guess - v) for v in (left, above[i], corner)]
                add = (left, above[i], corner)[away.index(min(away))]
            else:
                add = (0, left, above[i], (left + above[i]) // 2)[how]
            line[i] = (line[i] + add) & 255
        above = line
        values += struct.unpack(">%d%s" % (width, "H" if bits == 16 else "B"), bytes(line))
    return width, height, values


def mask_of(label):
    """Pixels of an annotation, as row * width + column."""
    height, width = label["segmentation"]["size"]
    pixels, at, inside = set(), 0, False
    for run in label["segmentation"]["counts"]:
        if inside:
            pixels.update((k % height) * width + k // height for k in range(at, at + run))
        at, inside = at + run, not inside
    assert at == width * height, "runs do not fill the picture"
    return pixels


def box_of(pixels, width):
    columns, rows = [p % width for p in pixels], [p // width for p in pixels]
    return [min(columns), min(rows), max(columns) - min(columns) + 1, max(rows) - min(rows) + 1]


def overlap(found, true, crowd):
    """Intersection over union of boxes; over the one found where the other is a crowd."""
    x = min(found[0] + found[2], true[0] + true[2]) - max(found[0], true[0])
    y = min(found[1] + found[3], true[1] + true[3]) - max(found[1], true[1])
    both = max(x, 0.0) * max(y, 0.0)
    return both / (found[2] * found[3] + (0.0 if crowd else true[2] * true[3] - both))


def matches(found, true, least):
    """(score, hit) of the boxes found in one picture; what only meets a crowd is left out."""
    taken, boxes = set(), []
    for box in sorted(found, key=lambda f: -f["score"])[:100]:
        best, share = None, min(least, 1 - 1e-10)
        for k, label in enumerate(sorted(true, key=lambda t: t["iscrowd"])):
            if k in taken and not label["iscrowd"]:
                continue
            if best is not None and not best[1]["iscrowd"] and label["iscrowd"]:
                break
            now = overlap(box["bbox"], label["bbox"], label["iscrowd"])
            if now >= share:
                best, share = (k, label), now
        if best is None:
            boxes.append((box["score"], False))
        elif not best[1]["iscrowd"]:
            taken.add(best[0])
            boxes.append((box["score"], True))
    return boxes


def average_precision(coco, found):
    precisions = []
    for category in coco["categories"]:
        def of(labels, image):
            return [a for a in labels
                    if a["image_id"] == image["id"] and a["category_id"] == category["id"]]

        count = sum(not a["iscrowd"] for i in coco["images"] for a in of(coco["annotations"], i))
        if count == 0:
            continue
        for step in range(10):
            boxes = [m for i in coco["images"]
                    for m in matches(of(found, i), of(coco["annotations"], i), 0.5 + 0.05 * step)]
            hits, curve = 0, []
            for seen, (_, hit) in enumerate(sorted(boxes, key=lambda m: -m[0]), 1):
                hits += hit
                curve.append((hits / count, hits / seen))
            precisions.append(sum(max([p for r, p in curve if r >= k / 100], default=0.0)
                                  for k in range(101)) / 101)
    return sum(precisions) / len(precisions)


def compare(folder, coco, wrong):
    """Every picture and label with the planes; counts in `wrong`."""
    of_image = {image["id"]: [] for image in coco["images"]}
    for label in coco["annotations"]:
        of_image[label["image_id"]].append(label)
    for image in coco["images"]:
        planes = read_exr(os.path.join(folder, image["planes"]))
        width, height, grey = read_grey_png(os.path.join(folder, image["file_name"]))
        wrong["size"] += (width, height) != (image["width"], image["height"])
        scale, shown = image["scale"], planes[image["scale"]["plane"]]
        first, last = scale["zero"], scale["zero"] + scale["step"] * (2 ** scale["bits"] - 1)
        wrong["grey"] += sum(abs(scale["zero"] + scale["step"] * g - min(max(v, first), last)) >
                             0.51 * scale["step"] for g, v in zip(grey, shown))
        wrong["grey"] += scale["pixels_beyond"] != sum(
            v < first - 0.5 * scale["step"] or v > last + 0.5 * scale["step"] for v in shown)
        behind = planes.get("object_behind." + image["band"], [-1.0] * len(shown))
        warmth = planes["apparent_temperature." + image["band"]]
        for label in of_image[image["id"]]:
            number = label["instance"]["object_id"]
            seen = {p for p in range(len(shown))
                    if number in (planes["object"][p], behind[p])}
            wrong["mask"] += mask_of(label) != seen
            wrong["area"] += label["area"] != len(seen)
            wrong["box"] += label["bbox"] != box_of(seen, width)
            mean = sum(warmth[p] for p in seen) / len(seen)
            contrast = label["contrast"]["apparent_temperature_K"]
            if contrast is not None:
                wrong["contrast"] += abs(contrast["target"] - mean) > 1e-3
        # YOLO: class from 0, middle and size as shares.
        name = os.path.join(folder, image["file_name"]).replace("/images/", "/labels/")
        lines = sorted(open(name[:-3] + "txt").read().split("\n")[:-1])
        expected = []
        for label in of_image[image["id"]]:
            if not label["iscrowd"]:
                x, y, w, h = label["bbox"]
                expected.append((label["category_id"] - 1, (x + w / 2) / width,
                                 (y + h / 2) / height, w / width, h / height))
        got = [tuple(float(v) for v in line.split()) for line in lines]
        wrong["yolo"] += len(got) != len(expected) or any(
            max(abs(a - b) for a, b in zip(one, two)) > 1e-5
            for one, two in zip(sorted(got), sorted(expected)))


def main(folder):
    coco = json.load(open(os.path.join(folder, "annotations.json")))
    wrong = dict.fromkeys(("ids", "size", "grey", "mask", "area", "box", "contrast", "yolo"), 0)
    for name in ("images", "annotations", "categories"):
        ids = [entry["id"] for entry in coco[name]]
        wrong["ids"] += len(ids) - len(set(ids)) + sum(i < 1 for i in ids)
    known = {c["id"] for c in coco["categories"]}
    wrong["ids"] += sum(a["category_id"] not in known for a in coco["annotations"])
    compare(folder, coco, wrong)
    print("images", len(coco["images"]))
    print("annotations", len(coco["annotations"]))
    for name, count in wrong.items():
        print("wrong_" + name, count)

    def shifted(least):
        """Each box aside, so that it overlaps its own by `least`."""
        found = []
        for label in coco["annotations"]:
            x, y, w, h = label["bbox"]
            found.append(dict(label, score=0.5 + 0.4 / label["id"],
                              bbox=[x + w * (1 - least) / (1 + least), y, w, h]))
        return found

    print("precision_of_truth %.6f" % average_precision(coco, shifted(1.0)))
    print("precision_of_overlap_0.62 %.6f" % average_precision(coco, shifted(0.62)))
    print("precision_of_nothing %.6f" % average_precision(coco, []))


main(sys.argv[1])
