"""render_mitsuba.py SCENE.xml SPP BATCHES PREFIX: PREFIX_1.pfm and so on by Mitsuba 3, each with a seed of its own."""
import sys

import mitsuba


def main():
    scene_file, spp, batches, prefix = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    mitsuba.set_variant("scalar_rgb")  # the variants of LLVM end the process with some versions of its library
    scene = mitsuba.load_file(scene_file, optimize=False)  # merging of meshes changes their shading
    for number in range(1, batches + 1):
        picture = mitsuba.render(scene, spp=spp, seed=number)
        mitsuba.Bitmap(picture).convert(mitsuba.Bitmap.PixelFormat.RGB, mitsuba.Struct.Type.Float32, False).write(
            f"{prefix}_{number}.pfm")
    print(f"Mitsuba {mitsuba.__version__}, {mitsuba.variant()}")


main()
