#!/usr/bin/env python3
"""Blender's Cycles on the mesh of render_bench: rough ground of 2 million triangles, seen from the
air, emission alone, 16 samples a pixel, on the processor.

    python3 bench/cycles_peer.py [posts = 1001] [size = 1024] [threads = 1]

Needs Debian's package `blender` (not among those of setup.sh); without it, says so and ends well.
Prints one row as render_bench does: the wall time of the render alone, without making the mesh.
"""

import math
import shutil
import subprocess
import sys
import time


def relief(x, y):
    """Height [m], as in render_bench."""
    z, wave, height, angle = 0.0, 8000.0, 300.0, 0.4
    for octave in range(9):
        k = 2.0 * math.pi / wave
        z += (height * math.sin(k * (x * math.cos(angle) + y * math.sin(angle)) + octave)
              * math.cos(k * 0.8 * (y * math.cos(angle) - x * math.sin(angle)) + 2.0 * octave))
        wave *= 0.5
        height *= 0.5
        angle += 1.3
    return z


def render_in_blender(posts, size, threads):
    import bpy
    from mathutils import Vector

    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    side, step = 10e3, 10e3 / (posts - 1)
    vertices = [(i * step - 0.5 * side, j * step - 0.5 * side,
                 relief(i * step - 0.5 * side, j * step - 0.5 * side))
                for j in range(posts) for i in range(posts)]
    triangles = []
    for j in range(posts - 1):
        for i in range(posts - 1):
            a = j * posts + i
            triangles += [(a, a + 1, a + posts + 1), (a, a + posts + 1, a + posts)]
    mesh = bpy.data.meshes.new("ground")
    mesh.from_pydata(vertices, [], triangles)
    material = bpy.data.materials.new("warm")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    emission = nodes.new("ShaderNodeEmission")
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("ground", mesh))

    camera = bpy.data.cameras.new("aerial")
    camera.angle = math.radians(50.0)
    camera.clip_end = 1e5
    eye = bpy.data.objects.new("aerial", camera)
    eye.location = (-6000.0, -6000.0, 3000.0)
    towards = Vector((0.0, 0.0, -300.0)) - eye.location
    eye.rotation_euler = towards.to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(eye)
    scene.camera = eye

    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 16
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.threads_mode = "FIXED"
    scene.render.threads = threads
    scene.render.use_persistent_data = True
    bpy.ops.render.render()  # builds the tree of boxes
    begin = time.monotonic()
    bpy.ops.render.render()
    seconds = time.monotonic() - begin
    print(f"peer,cycles_{bpy.app.version_string},{size}x{size}x16,{len(triangles)},{threads},"
          f"{seconds:.4f},{1e-6 * 16 * size * size / seconds:.4g},Mray/s", flush=True)


def main():
    if "--" in sys.argv:
        render_in_blender(*map(int, sys.argv[sys.argv.index("--") + 1:]))
        return 0
    arguments = [int(a) for a in sys.argv[1:]]
    defaults = [1001, 1024, 1]
    arguments += defaults[len(arguments):]
    blender = shutil.which("blender")
    if blender is None:
        print("skipped: no blender here (apt-get install blender)", file=sys.stderr)
        return 0
    done = subprocess.run([blender, "--background", "--factory-startup", "--python", __file__, "--",
                           *map(str, arguments)], capture_output=True, text=True)
    rows = [line for line in done.stdout.splitlines() if line.startswith("peer,")]
    if not rows:
        print(done.stdout[-2000:] + done.stderr[-2000:], file=sys.stderr)
        return 1
    print("case,method,setting,facets,threads,wall_s,error,unit")
    print("\n".join(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
