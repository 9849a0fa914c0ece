# Lights by lightcal. Not executed in Unreal Engine: checked against its documented names.
# Run in the editor with the Python plugin: py "THIS FILE". The lights come into the level that is
# open; run again, it replaces its own, found by their tag, and leaves all else as it is; one undo
# takes them back. NAME.rig.unreal.py opens a level of its own with cards, camera and exposure.
import json
import os
import re

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


def import_ies(name):
    task = unreal.AssetImportTask()
    put(task, "filename", os.path.join(os.path.dirname(os.path.abspath(__file__)), name))
    put(task, "destination_path", FOLDER)
    put(task, "automated", True)
    put(task, "replace_existing", True)
    put(task, "save", True)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    return unreal.load_asset(task.get_editor_property("imported_object_paths")[0])


def add_light(item):
    actor_class, component_class = COMPONENTS[item["class"]]
    actor = spawn(actor_class, item)
    component = actor.get_component_by_class(component_class)
    component.set_mobility(unreal.ComponentMobility.MOVABLE)
    if item["class"] != "DirectionalLight":
        put(component, "intensity_units", unreal.LightUnits.CANDELAS)
    if item["class"] in ("PointLight", "SpotLight"):
        put(component, "use_inverse_squared_falloff", True)
    red, green, blue = item["light_color"]
    put(component, "light_color", unreal.Color(b=blue, g=green, r=red, a=255))
    put(component, "use_temperature", item["use_temperature"])
    for name, value in item["properties"].items():
        put(component, name, float(value))
    if "ies" in item:
        profile = import_ies(item["ies"])
        put(component, "ies_texture", profile)
        put(component, "use_ies_brightness", False)
        # The profile's peak is 1 times this multiplier in every version of the engine.
        multiplier = profile.get_editor_property("texture_multiplier")
        put(component, "intensity", float(item["properties"]["intensity"]) / multiplier)


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


if "rig" not in DATA or open_rig_level():
    bring_lights()
