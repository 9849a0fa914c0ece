# Written by lightcal: measured lamps in Blender 3.4 and later, linked to their light.json and live.
# SPDX-License-Identifier: Apache-2.0
"""Sidebar of the 3D view, tab "lightcal": link a light.json or a folder of them, place lamps, see
each value beside its interval, move a lamp's controls, lock the exposure, measure a card. A file
that changes is taken within a second; where a person put a lamp, and what they called it, stays."""
import bpy
import bpy.utils.previews
from bpy.app.handlers import persistent
from bpy.props import PointerProperty

from . import cards, lamps, laws, panel

bl_info = {
    'name': 'lightcal',
    'author': 'lightcal',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': '3D View > Sidebar > lightcal',
    'description': 'Measured lamps, linked and live',
    'category': 'Lighting',
}

SECONDS = 0.5  # between two looks at the files
add_card = cards.add_card


def poll(force=False):
    """Looks at every linked file once; True where one was taken. A file that is being written is
    looked at again, and the lamps stay as they are."""
    changed = False
    for scene in bpy.data.scenes:
        state = scene.lightcal
        for link in state.links:
            stamp = lamps.stamp_of(link.path)
            if stamp == link.stamp and not force and link.path in lamps.READ:
                continue
            if not stamp:
                link.message = 'is gone; its lamps stay as they are'
                link.stamp = stamp
                continue
            try:
                link.message = lamps.take(scene, link.path)
                link.stamp = stamp
                changed = True
            except laws.BadLight as fault:
                link.message = str(fault)
        if changed or (state.links and not state.lamps):
            panel.list_lamps(state)
        cards.keep_exposure(scene)
        if lamps.follow_sliders(scene) or changed:
            panel.redraw()
    return changed


def timer():
    poll()
    return SECONDS


@persistent
def on_change(scene, *_):
    """A slider that was moved, or a frame of an animation."""
    lamps.follow_sliders(scene)


BUTTONS = panel.buttons(lambda _context: poll(force=True) and None)
HANDLERS = (bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.frame_change_post)


def register():
    for one in panel.CLASSES + BUTTONS:
        bpy.utils.register_class(one)
    bpy.types.Scene.lightcal = PointerProperty(type=panel.LightcalState)
    panel.PREVIEWS['all'] = bpy.utils.previews.new()
    for handlers in HANDLERS:
        handlers.append(on_change)
    bpy.app.timers.register(timer, first_interval=SECONDS, persistent=True)


def unregister():
    if bpy.app.timers.is_registered(timer):
        bpy.app.timers.unregister(timer)
    for handlers in HANDLERS:
        handlers.remove(on_change)
    bpy.utils.previews.remove(panel.PREVIEWS.pop('all'))
    lamps.READ.clear()
    del bpy.types.Scene.lightcal
    for one in reversed(panel.CLASSES + BUTTONS):
        bpy.utils.unregister_class(one)
