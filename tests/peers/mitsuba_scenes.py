"""Scenes for Mitsuba 3 as XML, which pathlight opens as it is. Each is a function of a folder: it writes the files that the scene
names, and returns its XML."""
import math
import struct
import zlib

from pictures import write_pfm

WIDTH, HEIGHT = 64, 48
WHITE, RED, GREEN = "0.73, 0.71, 0.68", "0.63, 0.065, 0.05", "0.14, 0.45, 0.091"


def diffuse(color):
    return f'<bsdf type="diffuse"><rgb name="reflectance" value="{color}"/></bsdf>'


def shape(kind, place, surface, more=""):
    """All surfaces of pathlight have two sides; `surface` with its own sides begins with '<bsdf type="dielectric"' or the like, or is a
    mask."""
    has_sides = any(kind in surface.split(">")[0] for kind in ("dielectric", "mask"))
    bsdf = surface if has_sides else f'<bsdf type="twosided">{surface}</bsdf>'
    return f'<shape type="{kind}">{more}<transform name="to_world">{place}</transform>{bsdf}</shape>'


def scaled(x, y, z):
    return f'<scale x="{x}" y="{y}" z="{z}"/>'


def turned(axis, degrees):
    return f'<rotate {axis}="1" angle="{degrees}"/>'


def moved(x, y, z):
    return f'<translate x="{x}" y="{y}" z="{z}"/>'


def box(surface, center, half, degrees=0):
    return shape("cube", scaled(*half) + turned("y", degrees) + moved(*center), surface)


def scene(content, eye=(0, 1, 3.6), target=(0, 1, 0), fov=40):
    return f"""<scene version="3.0.0">
<integrator type="path"><integer name="max_depth" value="65"/><integer name="rr_depth" value="8"/></integrator>
<sensor type="perspective"><string name="fov_axis" value="y"/><float name="fov" value="{fov}"/>
<transform name="to_world"><lookat origin="{eye[0]}, {eye[1]}, {eye[2]}" target="{target[0]}, {target[1]}, {target[2]}" up="0, 1, 0"/></transform>
<sampler type="independent"/>
<film type="hdrfilm"><integer name="width" value="{WIDTH}"/><integer name="height" value="{HEIGHT}"/>
<rfilter type="box"/><string name="pixel_format" value="rgb"/><string name="component_format" value="float32"/></film></sensor>
{content}
</scene>
"""


def emitting(kind, place):
    return (f'<shape type="{kind}"><transform name="to_world">{place}</transform>' + diffuse("0, 0, 0") +
            '<emitter type="area"><rgb name="radiance" value="17, 12, 4"/></emitter></shape>')


def ball(surface, center, radius):
    return shape("sphere", scaled(*(radius,) * 3) + moved(*center), surface)


def room(lamp=emitting("rectangle", scaled(0.25, 0.25, 1) + turned("x", 90) + moved(0, 1.98, 0))):
    """2 x 2 x 2 meters, open towards the camera, with a lamp, by default of 0.5 x 0.5 below its ceiling."""
    return "\n".join((shape("rectangle", turned("x", -90), diffuse(WHITE)),
                      shape("rectangle", turned("x", 90) + moved(0, 2, 0), diffuse(WHITE)),
                      shape("rectangle", moved(0, 1, -1), diffuse(WHITE)),
                      shape("rectangle", turned("y", 90) + moved(-1, 1, 0), diffuse(RED)),
                      shape("rectangle", turned("y", -90) + moved(1, 1, 0), diffuse(GREEN)), lamp))


def delta_lights():
    """A point and a spot inside of the room, and a direction through its open side."""
    return ('<emitter type="point"><point name="position" x="-0.7" y="1.5" z="0.3"/><rgb name="intensity" value="1.2, 0.6, 0.3"/></emitter>'
            '<emitter type="spot"><transform name="to_world"><lookat origin="0.6, 1.8, 0.8" target="-0.2, 0.3, -0.4" up="0, 1, 0"/></transform>'
            '<rgb name="intensity" value="2, 6, 4"/><float name="cutoff_angle" value="30"/><float name="beam_width" value="12"/></emitter>'
            '<emitter type="directional"><vector name="direction" x="0.4" y="-0.5" z="-1"/><rgb name="irradiance" value="1, 1, 3"/></emitter>')


def ground(surface):
    return shape("rectangle", scaled(4, 4, 1) + turned("x", -90), surface)


def sky(color="0.5, 0.65, 0.9"):
    return f'<emitter type="constant"><rgb name="radiance" value="{color}"/></emitter>'


def in_room(tall, short):
    return scene(room() + box(tall, (-0.35, 0.59, -0.3), (0.3, 0.6, 0.3), 18) +
                 box(short, (0.35, 0.29, 0.3), (0.3, 0.3, 0.3), -17))


def round_lights():
    """A room with an emitting sphere of 0.3 meters that is seen, and an emitting disk."""
    lamps = (emitting("sphere", scaled(0.15, 0.15, 0.15) + moved(0.3, 1.4, -0.2)) +
             emitting("disk", scaled(0.2, 0.2, 1) + turned("x", 90) + moved(-0.4, 1.98, 0)))
    return scene(room(lamps) + ball(diffuse(WHITE), (-0.35, 0.45, -0.3), 0.44) +
                 box(diffuse(WHITE), (0.35, 0.29, 0.3), (0.3, 0.3, 0.3), -17))


def balls_outside(left, right):
    content = ground(diffuse(WHITE)) + sky() + ball(left, (-0.6, 0.62, -0.3), 0.6) + ball(right, (0.55, 0.42, 0.3), 0.4)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def cropped_room(tall, short):
    """A part of a larger picture, off its middle and off the optical axis."""
    whole = f'<integer name="width" value="{WIDTH}"/><integer name="height" value="{HEIGHT}"/>'
    part = ('<integer name="width" value="160"/><integer name="height" value="112"/>'
            '<integer name="crop_offset_x" value="70"/><integer name="crop_offset_y" value="20"/>'
            f'<integer name="crop_width" value="{WIDTH}"/><integer name="crop_height" value="{HEIGHT}"/>')
    point = '<float name="principal_point_offset_x" value="0.1"/><float name="principal_point_offset_y" value="-0.05"/>'
    return in_room(tall, short).replace(whole, part).replace("<film", point + "<film")


def in_lit_room(tall, short):
    """With lights without extent beside the lamp."""
    return in_room(tall, short).replace("</scene>", delta_lights() + "</scene>")


def outside(light, tall, short, floor=None):
    content = ground(floor or diffuse(WHITE)) + light
    content += box(tall, (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25) + box(short, (0.5, 0.39, 0.3), (0.4, 0.4, 0.4), -20)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def map_radiance(u, v):
    """A sky of three soft patches of light; u, v in [0, 1], v from the top. Periodic in u, so that no seam shows."""
    up = math.cos(math.pi * v)
    total = [0.15 + 0.1 * up, 0.2 + 0.1 * up, 0.3 + 0.15 * up]
    for at, height, color in ((0.2, 0.6, (9, 7, 4)), (0.55, 0.35, (2, 5, 8)), (0.85, 0.8, (5, 5, 5))):
        near = 6 * (math.cos(2 * math.pi * (u - at)) * math.sin(math.pi * v) * math.sqrt(1 - height * height) +
                    up * height - 1)
        for k in range(3):
            total[k] += color[k] * math.exp(near)
    return total


def environment_map(folder):
    width, height = 1024, 512
    values = [c for y in range(height) for x in range(width)
              for c in map_radiance((x + 0.5) / width, (y + 0.5) / height)]
    write_pfm(folder / "map.pfm", width, height, values)
    return ('<emitter type="envmap"><string name="filename" value="map.pfm"/>'
            '<transform name="to_world"><rotate y="1" angle="40"/></transform></emitter>')


def png(width, height, texel):
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in texel(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def stripes(x, y):
    return (40 + 6 * x, 200 - 5 * y, 90 + 60 * ((x // 4 + y // 4) % 2))


GROUND = "v -4 0 4\nv 4 0 4\nv 4 0 -4\nv -4 0 -4\nvt 0 0\nvt 6 0\nvt 6 4\nvt 0 4\nf 1/1 2/2 3/3 4/4\n"


def textured(folder):
    (folder / "stripes.png").write_bytes(png(32, 32, stripes))
    (folder / "ground.obj").write_text(GROUND)
    image = ('<bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="stripes.png"/>'
             '</texture></bsdf>')
    content = (f'<shape type="obj"><string name="filename" value="ground.obj"/><bsdf type="twosided">{image}</bsdf></shape>' +
               sky() + box(image, (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25) +
               shape("rectangle", scaled(0.4, 0.4, 1) + turned("y", -20) + moved(0.5, 0.45, 0.3), image))
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def blend(weight, first, second):
    return f'<bsdf type="blendbsdf">{weight}{first}{second}</bsdf>'


def blended(folder):
    """Blends by numbers, one inside of another, and by an image; without mirrors, which Mitsuba blends wrongly."""
    (folder / "veil.png").write_bytes(png(32, 32, veil))
    (folder / "ground.obj").write_text(GROUND)
    image = ('<texture type="bitmap" name="weight"><string name="filename" value="veil.png"/>'
             '<boolean name="raw" value="true"/></texture>')

    def weight(value):
        return f'<float name="weight" value="{value}"/>'

    metal = rough_metal(0.01)
    ground_surface = blend(image, diffuse(RED), diffuse(WHITE))
    content = (f'<shape type="obj"><string name="filename" value="ground.obj"/>'
               f'<bsdf type="twosided">{ground_surface}</bsdf></shape>' + sky())
    content += box(blend(weight(0.4), metal, diffuse(RED)), (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25)
    content += box(blend(weight(0.3), blend(weight(0.6), diffuse(GREEN), metal), blend(weight(0.5), diffuse("0, 0, 0"), diffuse(WHITE))),
                   (0.5, 0.39, 0.3), (0.4, 0.4, 0.4), -20)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def veil(x, y):
    """Soft stripes from clear to opaque, which show the direction of an image."""
    return (round(127.5 * (1 + math.cos(math.pi * (x + y / 2) / 8))),) * 3


def masked(folder):
    """Sheets and a block that let light through, by a number and by an image, before and around other surfaces."""
    (folder / "veil.png").write_bytes(png(32, 32, veil))

    def mask(opacity, color):
        return f'<bsdf type="mask">{opacity}<bsdf type="twosided">{diffuse(color)}</bsdf></bsdf>'

    image = mask('<texture type="bitmap" name="opacity"><string name="filename" value="veil.png"/>'
                 '<boolean name="raw" value="true"/></texture>', GREEN)
    content = ground(diffuse(WHITE)) + sky() + box(diffuse(RED), (-0.55, 0.39, -0.4), (0.2, 0.4, 0.2), 25)
    content += box(mask('<float name="opacity" value="0.4"/>', WHITE), (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25)
    content += shape("rectangle", scaled(0.5, 0.5, 1) + turned("y", -20) + moved(0.5, 0.55, 0.3), image)
    content += box(diffuse(WHITE), (0.5, 0.39, -0.4), (0.3, 0.4, 0.3), -20)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def vertex_colored(folder):
    """A ground of large triangles with colors of its vertices, and surfaces of one color."""
    points = [(x, z) for z in range(-4, 5, 2) for x in range(-4, 5, 2)]
    rows = [f"{x} 0 {z} {0.5 + x / 10} {0.2 + 0.6 * (z % 4 == 0)} {0.5 - z / 10}" for x, z in points]
    first = [5 * j + i for j in range(4) for i in range(4)]
    faces = [face for k in first for face in (f"3 {k} {k + 5} {k + 6}", f"3 {k} {k + 6} {k + 1}")]
    properties = "".join(f"property float {name}\n" for name in ("x", "y", "z", "r", "g", "b"))
    (folder / "colors.ply").write_text(f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{properties}element face {len(faces)}\n"
                                       "property list uchar int vertex_indices\nend_header\n" + "\n".join(rows + faces) + "\n")
    colors = ('<bsdf type="diffuse"><texture type="mesh_attribute" name="reflectance"><string name="name" value="vertex_color"/>'
              '</texture></bsdf>')
    content = f'<shape type="ply"><string name="filename" value="colors.ply"/><bsdf type="twosided">{colors}</bsdf></shape>' + sky()
    content += box(diffuse(WHITE), (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25) + box(diffuse(RED), (0.5, 0.39, 0.3), (0.4, 0.4, 0.4), -20)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def relief(x, y):
    """Normals of soft waves with a slant: the directions of red and green show, and turned over green. Few face away from a viewer,
    which makes them black in Mitsuba."""
    normal = [0.1 * math.sin(math.pi * x / 8) + 0.06, 0.07 * math.cos(math.pi * y / 8) - 0.05, 1.0]
    length = math.sqrt(sum(c * c for c in normal))
    return tuple(round(127.5 * (c / length + 1)) for c in normal)


def normal_mapped(folder, inside):
    (folder / "relief.png").write_bytes(png(32, 32, relief))
    (folder / "ground.obj").write_text(GROUND)
    bumpy = ('<bsdf type="normalmap"><texture type="bitmap" name="normalmap"><boolean name="raw" value="true"/>'
             '<string name="filename" value="relief.png"/></texture><boolean name="use_shadowing_function" value="false"/>'
             f'<boolean name="flip_invalid_normals" value="false"/>{inside}</bsdf>')
    sun = emitting("rectangle", scaled(0.5, 0.5, 1) + turned("x", 90) + turned("z", -40) + moved(-2, 3, 1))
    content = (f'<shape type="obj"><string name="filename" value="ground.obj"/><bsdf type="twosided">{bumpy}</bsdf></shape>' +
               sky("0.1, 0.15, 0.2") + sun + box(bumpy, (-0.55, 0.29, -0.4), (0.35, 0.3, 0.35), 25) +
               shape("rectangle", scaled(0.4, 0.4, 1) + turned("y", -20) + moved(0.5, 0.45, 0.3), bumpy))
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def checkered(folder):
    (folder / "ground.obj").write_text(GROUND)

    def checkers(scale):
        return ('<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><rgb name="color0" value="0.8, 0.6, 0.2"/>'
                f'<rgb name="color1" value="0.1, 0.2, 0.5"/><transform name="to_uv"><scale x="{scale}" y="1.5"/>'
                '<translate x="0.1" y="0.3"/></transform></texture></bsdf>')

    content = (f'<shape type="obj"><string name="filename" value="ground.obj"/><bsdf type="twosided">{checkers(1.25)}</bsdf></shape>' +
               sky() + box(checkers(2), (-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25) +
               shape("rectangle", scaled(0.4, 0.4, 1) + turned("y", -20) + moved(0.5, 0.45, 0.3), checkers(3)))
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def heights(x, y):
    """Soft waves, not the same along x and y."""
    height = 0.5 + 0.25 * math.sin(math.pi * x / 16) + 0.2 * math.cos(math.pi * (x + y) / 32)
    return (round(255 * height),) * 3


def bump_mapped(folder, inside):
    (folder / "heights.png").write_bytes(png(64, 64, heights))
    (folder / "ground.obj").write_text(GROUND)

    def bumpy(scale):
        return (f'<bsdf type="bumpmap"><float name="scale" value="{scale}"/><texture type="bitmap" name="bump"><boolean '
                'name="raw" value="true"/><string name="filename" value="heights.png"/></texture>' + inside + '</bsdf>')

    sun = emitting("rectangle", scaled(0.5, 0.5, 1) + turned("x", 90) + turned("z", -40) + moved(-2, 3, 1))
    content = (f'<shape type="obj"><string name="filename" value="ground.obj"/><bsdf type="twosided">{bumpy(0.06)}</bsdf></shape>' +
               sky("0.1, 0.15, 0.2") + sun +
               shape("rectangle", scaled(0.6, 0.4, 1) + turned("y", -20) + moved(0.3, 0.5, 0.3), bumpy(0.03)))
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0))


def stained_glass():
    """Two blocks that absorb, each at its own rate: a color within (0, 1], times a scale."""
    def block(center, half, degrees, absorption, scale):
        ink = (f'<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="{absorption}"/>'
               f'<float name="scale" value="{scale}"/><rgb name="albedo" value="0, 0, 0"/></medium>')
        return shape("cube", scaled(*half) + turned("y", degrees) + moved(*center), GLASS, ink)

    content = ground(diffuse(WHITE)) + sky()
    content += block((-0.55, 0.59, -0.4), (0.35, 0.6, 0.35), 25, "0.12, 0.4, 1", 2.5)
    content += block((0.5, 0.39, 0.3), (0.4, 0.4, 0.4), -20, "1, 0.25, 0.1", 2)
    return scene(content, eye=(0.4, 1.7, 3.4), target=(0, 0.5, 0)).replace('type="path"', 'type="volpath"')


def clear_sky(sun='<vector name="sun_direction" x="0.6" y="0.7" z="0.4"/>'):
    return (f'<emitter type="sunsky"><float name="turbidity" value="4"/>{sun}'
            '<transform name="to_world"><rotate x="1" angle="-90"/></transform><float name="sun_scale" value="0.02"/></emitter>')


def dated_sky():
    """A February morning in Reykjavik."""
    whole = {"year": 2012, "month": 2, "day": 29}
    real = {"hour": 11, "minute": 20, "second": 30, "latitude": 64.15, "longitude": -21.94, "timezone": 0}
    return clear_sky("".join(f'<integer name="{name}" value="{value}"/>' for name, value in whole.items()) +
                     "".join(f'<float name="{name}" value="{value}"/>' for name, value in real.items()))


MIRROR = '<bsdf type="conductor"><string name="material" value="none"/></bsdf>'
GOLD = ('<bsdf type="conductor"><rgb name="eta" value="0.143, 0.375, 1.442"/><rgb name="k" value="3.983, 2.386, 1.603"/></bsdf>')
# Of a high index: Schlick's approximation is 15 % too bright near the edge.
CHROME = ('<bsdf type="conductor"><rgb name="eta" value="3.1, 3.2, 2.33"/><rgb name="k" value="3.3, 3.33, 3.14"/></bsdf>')
GLASS = '<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>'

PANE = '<bsdf type="thindielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>'


def rough_metal(alpha):
    return ('<bsdf type="roughconductor"><string name="material" value="none"/><string name="distribution" value="ggx"/>'
            f'<float name="alpha" value="{alpha}"/></bsdf>')


def brushed_metal(along_u, along_v):
    return ('<bsdf type="roughconductor"><string name="material" value="none"/><string name="distribution" value="ggx"/>'
            f'<float name="alpha_u" value="{along_u}"/><float name="alpha_v" value="{along_v}"/></bsdf>')


def rough_glass(alpha):
    return ('<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="int_ior" value="1.5"/>'
            f'<float name="ext_ior" value="1"/><float name="alpha" value="{alpha}"/></bsdf>')


def plastic(more="", kind="plastic"):
    return (f'<bsdf type="{kind}"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>'
            f'<rgb name="diffuse_reflectance" value="0.2, 0.5, 0.7"/>{more}</bsdf>')


NONLINEAR = '<boolean name="nonlinear" value="true"/>'
ROUGH = '<string name="distribution" value="ggx"/><float name="alpha" value="0.2"/>'
