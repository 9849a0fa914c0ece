# SPDX-License-Identifier: Apache-2.0
"""What the schemas of EXT_lights_image_based ask of a glTF file, and what its text asks beyond them.
Written anew from KhronosGroup/glTF extensions/2.0/Vendor/EXT_lights_image_based/schema (light.schema.json at
079476b3, glTF... at 77f0cf70, scene... at 079476b3). The Khronos validator does not know the extension."""
import jsonschema

LIGHT = {
    'type': 'object', 'additionalProperties': False,
    'required': ['irradianceCoefficients', 'specularImages', 'specularImageSize'],
    'properties': {
        'rotation': {'type': 'array', 'minItems': 4, 'maxItems': 4,
                     'items': {'type': 'number', 'minimum': 0.0, 'maximum': 1.0}},
        'intensity': {'type': 'number'},
        'irradianceCoefficients': {'type': 'array', 'minItems': 9, 'maxItems': 9,
                                   'items': {'type': 'array', 'minItems': 3, 'maxItems': 3,
                                             'items': {'type': 'number'}}},
        'specularImages': {'type': 'array', 'minItems': 1,
                           'items': {'type': 'array', 'minItems': 6, 'maxItems': 6,
                                     'items': {'type': 'integer', 'minimum': 0}}},
        'specularImageSize': {'type': 'number', 'minimum': 0},
        'name': {'type': 'string'}, 'extensions': {'type': 'object'}, 'extras': {}}}
ROOT = {'type': 'object', 'additionalProperties': False,
        'properties': {'lights': {'type': 'array', 'items': LIGHT}}}
SCENE = {'type': 'object', 'additionalProperties': False, 'required': ['light'],
         'properties': {'light': {'type': 'integer', 'minimum': 0}}}
NAME = 'EXT_lights_image_based'


def check(root):
    """Raises where the file is not what they ask; the number of its image based lights."""
    jsonschema.Draft4Validator.check_schema(ROOT)
    assert NAME in root['extensionsUsed'], 'extensionsUsed does not name it'
    assert NAME not in root.get('extensionsRequired', []), 'a file without it is lit as well'
    lights = root['extensions'][NAME]
    jsonschema.Draft4Validator(ROOT).validate(lights)
    for scene in root['scenes']:
        if NAME in scene.get('extensions', {}):
            jsonschema.Draft4Validator(SCENE).validate(scene['extensions'][NAME])
            assert scene['extensions'][NAME]['light'] < len(lights['lights'])
    for light in lights['lights']:
        size = light['specularImageSize']
        assert size == int(size) and size >= 1, 'the largest mip has whole pixels'
        # The first N mips of a cube: each half the one before, so no more than fit.
        assert len(light['specularImages']) <= int(size).bit_length(), 'more mips than the size has'
        for faces in light['specularImages']:
            assert all(at < len(root['images']) for at in faces), 'a face names no image'
    return len(lights['lights'])
