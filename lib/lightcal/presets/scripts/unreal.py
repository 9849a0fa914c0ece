# Lights by lightcal. Not executed in Unreal Engine: checked against its documented names.
# Run in the editor with the Python plugin: py "THIS FILE". The lights come into the level that is
# open; run again, it replaces its own, found by their tag, and leaves all else as it is; one undo
# takes them back. NAME.rig.unreal.py opens a level of its own with cards, camera and exposure.
# Exported with --into it makes nothing: it sets lights that are there, by label, or refuses.
# Lamps that were read at states of their controls can be turned afterwards, see set_state.
import json
import os
import re
import sys
import types

import unreal

DATA = json.loads(r'''@DATA@''')
FOLDER = "/Game/lightcal"
TAG = "lightcal:" + DATA["name"]
ACTORS = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
COMPONENTS = {
    "PointLight": (unreal.PointLight, unreal.PointLightComponent),
    "SpotLight": (unreal.SpotLight, unreal.SpotLightComponent),
    "RectLight": (unreal.RectLight, unreal.RectLightComponent),
    "DirectionalLight": (unreal.DirectionalLight, unreal.DirectionalLightComponent),
}


def is_own(actor):
    return TAG in [str(tag) for tag in actor.get_editor_property("tags")]


def owned(actor, label):
    actor.set_actor_label(label)
    actor.set_editor_property("tags", [unreal.Name(TAG)])
    return actor


def remove_own():
    for actor in ACTORS.get_all_level_actors():
        if is_own(actor):
            ACTORS.destroy_actor(actor)


def spawn(actor_class, item):
    pitch, yaw, roll = item["pitch_yaw_roll_deg"]
    actor = ACTORS.spawn_actor_from_class(
        actor_class,
        unreal.Vector(*item["location_cm"]),
        unreal.Rotator(roll=roll, pitch=pitch, yaw=yaw),
    )
    return owned(actor, item["name"])


def put(target, name, value):
    target.set_editor_property(name, value)
    if isinstance(value, float):
        held = target.get_editor_property(name)
        if abs(held - value) > 1e-4 * max(abs(value), 1e-4):
            unreal.log_warning("lightcal: %s is %r, not %r" % (name, held, value))


def import_asset(name):
    task = unreal.AssetImportTask()
    put(task, "filename", os.path.join(os.path.dirname(os.path.abspath(__file__)), name))
    put(task, "destination_path", FOLDER)
    put(task, "automated", True)
    put(task, "replace_existing", True)
    put(task, "save", True)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    paths = task.get_editor_property("imported_object_paths")
    return unreal.load_asset(paths[0]) if paths else None


def add_sky(item):
    """A measured panorama: texels in cd/m2 at intensity 1. The .hdr becomes a cubemap whose middle looks
    along -Y and whose right side is +X, so that it needs no turn (TextureCompressorModule.cpp,
    LookupLongLat). Light from below is off by default."""
    cubemap = import_asset(item["picture"])
    if not isinstance(cubemap, unreal.TextureCube):
        unreal.log_error("lightcal: %s did not come in as a cubemap: import it by hand as Texture Cube, "
                         "and give it to a sky light of intensity 1" % item["picture"])
        return
    for other in ACTORS.get_all_level_actors():
        if other.get_components_by_class(unreal.SkyLightComponent) and not is_own(other):
            unreal.log_warning("lightcal: the level has another sky light, %s: hide it, or both shine"
                               % other.get_actor_label())
    component = spawn(unreal.SkyLight, item).get_component_by_class(unreal.SkyLightComponent)
    component.set_mobility(unreal.ComponentMobility.MOVABLE)
    for name, value in (
        ("real_time_capture", False),
        ("source_type", unreal.SkyLightSourceType.SLS_SPECIFIED_CUBEMAP),
        ("cubemap", cubemap),
        ("source_cubemap_angle", 0.0),
        ("lower_hemisphere_is_black", False),
        ("light_color", unreal.Color(b=255, g=255, r=255, a=255)),
        ("intensity", float(item["properties"]["intensity"])),
    ):
        put(component, name, value)
    component.recapture_sky()


def add_light(item):
    if item["class"] == "SkyLight":
        add_sky(item)
        return
    actor_class, component_class = COMPONENTS[item["class"]]
    actor = spawn(actor_class, item)
    component = actor.get_component_by_class(component_class)
    component.set_mobility(unreal.ComponentMobility.MOVABLE)
    set_figures(component, item, item["properties"])


def fitting(component, item):
    """The lamp's figures as a light of this class has them. A size that was not measured is left as
    it is, for it changes no intensity here."""
    names = ["intensity"]
    if item["use_temperature"]:
        names.append("temperature")
    if isinstance(component, unreal.DirectionalLightComponent):
        names.append("light_source_angle")
    else:
        names.append("attenuation_radius")
    if isinstance(component, unreal.PointLightComponent) and item["properties"].get("source_radius"):
        names.append("source_radius")
    if isinstance(component, unreal.RectLightComponent):
        names += ["source_width", "source_height"]
    found = {name: item["properties"][name] for name in names if name in item["properties"]}
    if isinstance(component, unreal.SpotLightComponent):
        # Its own cone would cut a lamp of another class.
        found["inner_cone_angle"], found["outer_cone_angle"] = item["cone_deg"]
    if isinstance(component, unreal.RectLightComponent):
        found["barn_door_length"] = 0.0
    return found


def strays(component, item):
    """What a light of this class shows otherwise than the lamp; "" = nothing."""
    spot = isinstance(component, unreal.SpotLightComponent)
    if item["class"] == "PointLight" and spot:
        return "is a spot, dark beyond %.4g degrees from its aim; a point light shows all of" % (
            item["cone_deg"][1])
    if isinstance(component, COMPONENTS[item["class"]][1]):
        return ""
    if item["class"] == "RectLight" and spot:
        return "has no face: off its axis within 17 % of the axial intensity; a rect light shows"
    return "has no such beam: right on the axis alone; a %s shows" % (
        "spot light" if item["class"] == "SpotLight" else "light of class " + item["class"])


def set_figures(component, item, properties):
    if not isinstance(component, unreal.DirectionalLightComponent):
        put(component, "intensity_units", unreal.LightUnits.CANDELAS)
    if isinstance(component, unreal.PointLightComponent):
        put(component, "use_inverse_squared_falloff", True)
    red, green, blue = item["light_color"]
    put(component, "light_color", unreal.Color(b=blue, g=green, r=red, a=255))
    put(component, "use_temperature", item["use_temperature"])
    for name, value in properties.items():
        put(component, name, float(value))
    if "ies" in item:
        profile = import_asset(item["ies"])
        put(component, "ies_texture", profile)
        put(component, "use_ies_brightness", False)
        # The profile's peak is 1 times this multiplier in every version of the engine.
        multiplier = profile.get_editor_property("texture_multiplier")
        put(component, "intensity", float(item["properties"]["intensity"]) / multiplier)


def decoded(byte):
    value = byte / 255.0
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def encoded(value):
    value = min(max(value, 0.0), 1.0)
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055))


def luminance(color):
    return 0.2126390058715104 * color[0] + 0.7151686787677560 * color[1] + 0.0721923153607337 * color[2]


def on_the_curve(control, label):
    """[energy, r, g, b] over those of the reference."""
    table = control["table"]
    least, most = table[0][0], table[-1][0]
    slack = 1e-9 * max(abs(least), abs(most))
    if not least - slack <= label <= most + slack:
        raise ValueError("%s = %g lies outside of what was read (%g ... %g)" % (
            control["control"], label, least, most))
    for below, above in zip(table, table[1:]):
        if label <= above[0]:
            share = min(max((label - below[0]) / (above[0] - below[0]), 0.0), 1.0)
            return [a + share * (b - a) for a, b in zip(below[1:], above[1:])]
    return table[-1][1:]


def at_state(item, state):
    """(candela or lux, [r, g, b]) of a lamp: its figures along what was measured, controls taken to
    act independently."""
    figure, color = item["measured"], list(item["linear"])
    of_reference = luminance(color)
    for control in item["controls"]:
        energy, *tint = on_the_curve(control, state[control["control"]])
        figure *= energy
        color = [a * b for a, b in zip(color, tint)]
    return figure * luminance(color) / of_reference, color


STATE = "lightcal.state:"  # a tag an actor, which holds what its controls stand at


def state_of(actor, item):
    state = {control["control"]: control["reference"] for control in item["controls"]}
    for tag in (str(tag) for tag in actor.get_editor_property("tags")):
        if tag.startswith(STATE):
            name, _, label = tag[len(STATE):].partition("=")
            if name in state:
                state[name] = float(label)
    return state


def turn(actor, item, state):
    figure, color = at_state(item, state)
    most = max(color)
    held = [encoded(c / most) for c in color]
    shines = luminance([decoded(byte) for byte in held])
    for component in actor.get_components_by_class(unreal.LightComponent):
        component.modify()
        put(component, "use_temperature", False)
        put(component, "light_color", unreal.Color(b=held[2], g=held[1], r=held[0], a=255))
        profile = component.get_editor_property("ies_texture") if "ies" in item else None
        multiplier = profile.get_editor_property("texture_multiplier") if profile else 1.0
        put(component, "intensity", figure / shines / multiplier)
    kept = [tag for tag in actor.get_editor_property("tags") if not str(tag).startswith(STATE)]
    said = ["%s%s=%.9g" % (STATE, name, label) for name, label in state.items()]
    actor.set_editor_property("tags", kept + [unreal.Name(text) for text in said])


def lamps_with_controls():
    """(actor, item) of the lights of this export that are in the level."""
    for item in DATA["lights"]:
        if "controls" not in item:
            continue
        patterns = [row["object"] for row in DATA.get("into", []) if row["lamp"] == item["name"]]
        for actor in ACTORS.get_all_level_actors():
            label = str(actor.get_actor_label())
            own = is_own(actor) and label == item["name"]
            if own or any(matches(pattern, label) for pattern in patterns):
                if actor.get_components_by_class(unreal.LightComponent):
                    yield actor, item


def set_state(lamp=None, **controls):
    """set_state("key", dimmer=37, cct_K=4000) sets a lamp to what it gives when its controls say so;
    without a name every lamp that has these controls. What is not named stays. Labels are those of
    the fixture; beyond what was read it raises ValueError, and nothing is set. cct stands for cct_K."""
    if "cct" in controls:
        controls["cct_K"] = controls.pop("cct")
    wanted = []
    for actor, item in lamps_with_controls():
        state = state_of(actor, item)
        if lamp not in (None, item["name"]):
            continue
        if lamp is None and set(controls) - set(state):
            continue
        for name in controls:
            if name not in state:
                raise ValueError("%s has no control %s; it has %s" % (
                    item["name"], name, ", ".join(state)))
        state.update({name: float(label) for name, label in controls.items()})
        at_state(item, state)
        wanted.append((actor, item, state))
    if not wanted:
        there = ["%s (%s)" % (item["name"], ", ".join(state_of(actor, item)))
                 for actor, item in lamps_with_controls()]
        raise ValueError("no lamp of that name has these controls; the level has %s" % (
            ", ".join(there) or "none of this export"))
    with unreal.ScopedEditorTransaction("lightcal state"):
        for actor, item, state in wanted:
            turn(actor, item, state)


def offer_states():
    """A file that runs leaves no names behind: the console finds set_state in a module."""
    if not any("controls" in item for item in DATA["lights"]):
        return
    name = "lightcal_" + re.sub("[^A-Za-z0-9_]", "_", DATA["name"])
    sys.modules[name] = types.ModuleType(name, set_state.__doc__)
    sys.modules[name].set_state = set_state
    unreal.log("lightcal: to turn its controls:  py import %s; %s.set_state(%s)" % (
        name, name, ", ".join("%s=%g" % (control["control"], control["reference"])
                              for item in DATA["lights"] if "controls" in item
                              for control in item["controls"][:2])))


def matt(card):
    name = "M_lightcal_%d" % round(1000 * card["reflectance"])
    if unreal.EditorAssetLibrary.does_asset_exist(FOLDER + "/" + name):
        return unreal.load_asset(FOLDER + "/" + name)
    tools = unreal.AssetToolsHelpers.get_asset_tools()
    material = tools.create_asset(name, FOLDER, unreal.Material, unreal.MaterialFactoryNew())
    library = unreal.MaterialEditingLibrary
    for value, which in (
        (card["reflectance"], unreal.MaterialProperty.MP_BASE_COLOR),
        (1.0, unreal.MaterialProperty.MP_ROUGHNESS),
        (0.0, unreal.MaterialProperty.MP_SPECULAR),
    ):
        constant = library.create_material_expression(material, unreal.MaterialExpressionConstant)
        put(constant, "r", float(value))
        library.connect_material_property(constant, "", which)
    library.recompile_material(material)
    return material


def add_card(card):
    actor = spawn(unreal.StaticMeshActor, card)
    component = actor.get_component_by_class(unreal.StaticMeshComponent)
    component.set_static_mesh(unreal.load_asset("/Engine/BasicShapes/Plane"))
    component.set_material(0, matt(card))
    actor.set_actor_scale3d(unreal.Vector(card["scale"], card["scale"], 1.0))


def lock_exposure(bias):
    volume = ACTORS.spawn_actor_from_class(
        unreal.PostProcessVolume, unreal.Vector(0, 0, 0), unreal.Rotator(roll=0, pitch=0, yaw=0)
    )
    owned(volume, "lightcal exposure")
    put(volume, "unbound", True)
    settings = volume.get_editor_property("settings")
    for name, value in (
        ("auto_exposure_method", unreal.AutoExposureMethod.AEM_MANUAL),
        ("auto_exposure_apply_physical_camera_exposure", False),
        ("auto_exposure_bias", float(bias)),
        ("bloom_intensity", 0.0),
        ("vignette_intensity", 0.0),
        ("tone_curve_amount", 0.0),
        ("expand_gamut", 0.0),
    ):
        put(settings, "override_" + name, True)
        put(settings, name, value)
    put(volume, "settings", settings)


def add_camera(item):
    component = spawn(unreal.CameraActor, item).get_component_by_class(unreal.CameraComponent)
    put(component, "field_of_view", float(item["field_of_view"]))
    put(component, "aspect_ratio", float(item["aspect_ratio"]))
    put(component, "constrain_aspect_ratio", True)


def open_rig_level():
    """The rig's own level, new or that of an earlier run; False where work would be lost."""
    unsaved = unreal.EditorLoadingAndSavingUtils.get_dirty_map_packages()
    if unsaved:
        unreal.log_error("lightcal: nothing done: %s has changes that are not saved; save it, then "
                         "run this again" % unsaved[0].get_name())
        return False
    levels = unreal.get_editor_subsystem(unreal.LevelEditorSubsystem)
    path = FOLDER + "/" + re.sub("[^A-Za-z0-9_]", "_", DATA["name"])
    if unreal.EditorAssetLibrary.does_asset_exist(path):
        opened = levels.load_level(path)
    else:
        opened = levels.new_level(path)
    if not opened:
        unreal.log_error("lightcal: nothing done: the level %s cannot be opened" % path)
    return opened


def bring_lights():
    with unreal.ScopedEditorTransaction("lightcal " + DATA["name"]):
        remove_own()
        for light in DATA["lights"]:
            add_light(light)
        if "rig" in DATA:
            for card in DATA["rig"]["cards"]:
                add_card(card)
            lock_exposure(DATA["rig"]["exposure_bias"])
            add_camera(DATA["rig"]["camera"])
    unreal.log("lightcal: %d lights" % len(DATA["lights"]))


def matches(pattern, name):
    """* any letters, ? one; all else as it is."""
    spelled = re.escape(pattern).replace(r"\*", ".*").replace(r"\?", ".")
    return re.fullmatch(spelled, name, re.S) is not None


def figures(component):
    get = component.get_editor_property
    color = get("light_color")
    text = "intensity %.6g" % get("intensity")
    if isinstance(component, unreal.LocalLightComponent):
        text += " %s, radius of attenuation %.4g cm" % (
            getattr(get("intensity_units"), "name", get("intensity_units")), get("attenuation_radius"))
    text += ", %.4g K" % get("temperature") if get("use_temperature") else ", no temperature"
    text += ", colour %d %d %d" % (color.r, color.g, color.b)
    if isinstance(component, unreal.SpotLightComponent):
        text += ", cone %.4g to %.4g deg" % (get("inner_cone_angle"), get("outer_cone_angle"))
    if isinstance(component, unreal.PointLightComponent):
        text += ", source radius %.4g cm" % get("source_radius")
    if isinstance(component, unreal.RectLightComponent):
        text += ", source %.4g x %.4g cm" % (get("source_width"), get("source_height"))
    return text + (", photometric file" if get("ies_texture") else "")


def why_not(component, item):
    sun = isinstance(component, unreal.DirectionalLightComponent)
    if sun == (item["class"] == "DirectionalLight"):
        return ""
    return 'is %s, and "%s" was measured in %s; name a light that is %s' % (
        "directional" if sun else "no directional light", item["name"],
        "candela" if sun else "lux", "a point, spot or rect light" if sun else "directional")


def set_lights_that_are_there():
    """The rows of the export's --into; all of them, or nothing."""
    items = {item["name"]: item for item in DATA["lights"]}
    lights = {}
    for actor in ACTORS.get_all_level_actors():
        components = actor.get_components_by_class(unreal.LightComponent)
        if components:
            lights[actor] = (str(actor.get_actor_label()), components)
    taken, problems = {}, []
    for row in DATA["into"]:
        found = [actor for actor, (label, _) in lights.items() if matches(row["object"], label)]
        if not found:
            problems.append('no light of the level is called "%s"; it has %s' % (
                row["object"], ", ".join(label for label, _ in lights.values()) or "none"))
        for actor in found:
            label, components = lights[actor]
            if taken.setdefault(actor, row["lamp"]) != row["lamp"]:
                problems.append('"%s" would get two lamps, "%s" and "%s": leave one of the lines'
                                % (label, taken[actor], row["lamp"]))
            for why in {why_not(component, items[row["lamp"]]) for component in components} - {""}:
                problems.append('"%s" %s' % (label, why))
    if problems:
        for problem in problems:
            unreal.log_error("lightcal: nothing set: " + problem)
        return
    with unreal.ScopedEditorTransaction("lightcal " + DATA["name"]):
        for actor, lamp in taken.items():
            label, components = lights[actor]
            item = items[lamp]
            for component in components:
                before = figures(component)
                component.modify()
                if component.get_editor_property("ies_texture") and "ies" not in item:
                    component.set_editor_property("ies_texture", None)  # it would shape this lamp
                set_figures(component, item, fitting(component, item))
                unreal.log("lightcal: %s: %s -> %s   (%s)" % (label, before, figures(component), lamp))
                if strays(component, item):
                    unreal.log_warning('lightcal: %s %s "%s"' % (label, strays(component, item), lamp))


if "into" in DATA:
    set_lights_that_are_there()
    offer_states()
elif "rig" not in DATA or open_rig_level():
    bring_lights()
    offer_states()
