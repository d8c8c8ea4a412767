"""The scenes that other renderers show, too: what is compared with what, and how near they have to be.

`delta` is the resolution of rule S2: 0.3 % where everything is diffuse, 1 % with glossy surfaces. Where the models differ,
`differs` has the bounds of the difference of the means in red, green and blue, ours less theirs over their average, and `why` the reason:
such a case fails on either side of its bounds, so it tells when a model changes.
"""
from dataclasses import dataclass
from typing import Callable

import gltf_scenes
import mitsuba_scenes as xml

DIFFUSE, GLOSSY = 0.003, 0.01


@dataclass
class Case:
    name: str
    write: Callable  # (folder) -> text of XML, or bytes of a .glb
    delta: float
    ours: int  # samples per pixel of each batch
    theirs: int
    differs: tuple = ()
    why: str = ""


WHITE = xml.diffuse(xml.WHITE)

MITSUBA = [
    Case("cornell", lambda folder: xml.in_room(WHITE, WHITE), DIFFUSE, 96, 384),
    Case("film-crop", lambda folder: xml.cropped_room(WHITE, WHITE), DIFFUSE, 96, 384),
    Case("delta-lights", lambda folder: xml.in_lit_room(WHITE, WHITE), DIFFUSE, 96, 384),
    Case("sphere-light", lambda folder: xml.round_lights(), DIFFUSE, 96, 384),
    Case("sky", lambda folder: xml.outside(xml.sky(), WHITE, xml.diffuse(xml.RED)), DIFFUSE, 32, 64),
    Case("environment-map", lambda folder: xml.outside(xml.environment_map(folder), WHITE, xml.diffuse(xml.RED)), DIFFUSE,
         32, 128, ((-0.002, 0.002),) * 3, "Mitsuba spreads n texels of a map over n - 1 intervals"),
    Case("clear-sky", lambda folder: xml.outside(xml.clear_sky(), WHITE, xml.diffuse(xml.RED)), DIFFUSE, 32, 128,
         ((-0.002, 0.004),) * 3, "ours is a map whose texels blur the horizon by 0.7 degrees"),
    Case("dated-sky", lambda folder: xml.outside(xml.dated_sky(), WHITE, xml.diffuse(xml.RED)), DIFFUSE, 32, 128,
         ((-0.002, 0.004),) * 3, "ours is a map whose texels blur the horizon by 0.7 degrees"),
    Case("textured", xml.textured, DIFFUSE, 32, 64),
    Case("mask", xml.masked, DIFFUSE, 32, 96),
    Case("vertex-colors", xml.vertex_colored, DIFFUSE, 32, 64),
    Case("checkers", xml.checkered, DIFFUSE, 32, 64),
    Case("bump-map", lambda folder: xml.bump_mapped(folder, WHITE), DIFFUSE, 48, 128, ((0.0, 0.0025),) * 3,
         "a diffuse surface whose mapped normal faces away from the viewer is black in Mitsuba"),
    Case("normal-map", lambda folder: xml.normal_mapped(folder, WHITE), DIFFUSE, 48, 128, ((0.0, 0.002),) * 3,
         "a diffuse surface whose mapped normal faces away from the viewer is black in Mitsuba"),
    Case("mirror", lambda folder: xml.in_room(xml.MIRROR, WHITE), GLOSSY, 48, 128),
    Case("mirror-sphere", lambda folder: xml.balls_outside(xml.MIRROR, xml.diffuse(xml.RED)), GLOSSY, 32, 96),
    Case("gold", lambda folder: xml.in_room(xml.GOLD, xml.GOLD), GLOSSY, 48, 128),
    Case("chrome", lambda folder: xml.outside(xml.sky(), xml.CHROME, xml.CHROME), GLOSSY, 16, 32, ((-0.002, 0.002),) * 3,
         "Schlick's approximation with an edge tint is right at 0 and 82 degrees, and within a few percent between them"),
    Case("rough-metal", lambda folder: xml.outside(xml.sky(), xml.rough_metal(0.3), xml.rough_metal(0.1)), GLOSSY, 16, 32,
         ((0.023, 0.029),) * 3, "ours gives back the light that facets scatter several times, Mitsuba loses it"),
    Case("brushed-metal", lambda folder: xml.outside(xml.environment_map(folder), xml.brushed_metal(0.15, 0.02),
                                                     xml.brushed_metal(0.03, 0.12)), GLOSSY, 32, 128,
         ((0.009, 0.015),) * 3, "as for metal of equal widths; turned by 90 degrees it differs by +1 to -1.5 %"),
    Case("glass", lambda folder: xml.outside(xml.sky(), xml.GLASS, xml.GLASS), GLOSSY, 16, 32),
    Case("glass-sphere", lambda folder: xml.balls_outside(xml.GLASS, xml.diffuse(xml.RED)), GLOSSY, 32, 96),
    Case("stained-glass", lambda folder: xml.stained_glass(), GLOSSY, 32, 96),
    Case("thin-panes", lambda folder: xml.outside(xml.sky(), xml.PANE, xml.PANE), GLOSSY, 16, 32),
    Case("blends", xml.blended, GLOSSY, 32, 96),
    Case("rough-glass", lambda folder: xml.outside(xml.sky(), xml.rough_glass(0.3), xml.rough_glass(0.1)), GLOSSY, 16, 32,
         ((0.036, 0.043),) * 3, "as for metal: ours loses nothing in scattering between facets"),
    Case("plastic", lambda folder: xml.in_room(xml.plastic(), xml.plastic()), GLOSSY, 32, 96),
    Case("nonlinear-plastic", lambda folder: xml.in_room(xml.plastic(xml.NONLINEAR), xml.plastic(xml.NONLINEAR)), GLOSSY,
         32, 96),
    Case("rough-plastic", lambda folder: xml.in_room(xml.plastic(xml.ROUGH, "roughplastic"),
                                                     xml.plastic(xml.ROUGH, "roughplastic")), GLOSSY, 32, 96,
         ((0.006, 0.013), (0.019, 0.027), (0.024, 0.033)),
         "the coat's facets let more light through to the base than Mitsuba's, which lose what they scatter several times"),
]


def matte(g):
    return g.matte((0.73, 0.71, 0.68))


BLENDER = [
    Case("gltf-cornell", lambda folder: gltf_scenes.room(matte, matte), DIFFUSE, 128, 80),
    Case("gltf-metal", lambda folder: gltf_scenes.room(lambda g: g.material((0.95, 0.64, 0.54), metal=1, rough=0), matte),
         GLOSSY, 96, 64),
    Case("gltf-rough-metal", lambda folder: gltf_scenes.room(lambda g: g.material((0.95, 0.64, 0.54), metal=1, rough=0.5),
                                                             matte), GLOSSY, 32, 32,
         ((0.0, 0.006),) * 3, "Cycles scales its facets to give back what they scatter several times, ours adds a lobe of its own"),
    Case("gltf-glass", lambda folder: gltf_scenes.room(lambda g: g.glass(), matte), GLOSSY, 160, 128),
    Case("gltf-plastic", lambda folder: gltf_scenes.room(lambda g: g.material((0.2, 0.5, 0.7), rough=0.4), matte), GLOSSY,
         32, 32, ((-0.004, 0.001), (-0.007, -0.002), (-0.011, -0.006)),
         "Cycles dims the base by the coat towards the eye alone, ours towards the light, too, which is reciprocal"),
]
