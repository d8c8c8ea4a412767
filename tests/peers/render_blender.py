"""render_blender.py SCENE.glb SPP BATCHES PREFIX: PREFIX_1.pfm and so on by Cycles, each with a seed of its own."""
import os
import sys
import tempfile

import bpy

from pictures import write_pfm


def set_up(scene, width, height, spp):
    """Path tracing without any clamping, filtering or cache."""
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = spp
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 64
    cycles.transparent_max_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    cycles.sampling_pattern = "TABULATED_SOBOL"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.film_transparent = False
    scene.render.use_persistent_data = True


def pixels_of(file):
    """Rows from the top, three channels."""
    image = bpy.data.images.load(file)
    width, height = image.size
    values = list(image.pixels)
    bpy.data.images.remove(image)
    return [values[4 * (y * width + x) + k] for y in reversed(range(height)) for x in range(width) for k in range(3)]


def main():
    scene_file, spp, batches, prefix = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    width, height = 64, 48
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=scene_file)
    scene = bpy.context.scene
    scene.camera = next(item for item in scene.objects if item.type == "CAMERA")
    set_up(scene, width, height, spp)
    with tempfile.TemporaryDirectory() as folder:
        for number in range(1, batches + 1):
            scene.cycles.seed = number
            scene.render.filepath = os.path.join(folder, f"{number}.exr")
            bpy.ops.render.render(write_still=True)
            write_pfm(f"{prefix}_{number}.pfm", width, height, pixels_of(scene.render.filepath))
    print(f"Blender {bpy.app.version_string}, Cycles", flush=True)
    os._exit(0)  # as a module Blender may crash when Python ends


main()
