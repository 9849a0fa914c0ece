# SPDX-License-Identifier: Apache-2.0
"""A strict stand-in of the editor's `unreal` module: only documented names exist, and each property
takes its documented type. Source: Unreal Engine 5 Python API reference."""
import os
import sys
import types


class Enum:
    def __init__(self, name):
        self.name = name


class Struct:
    fields = {}

    def __init__(self, **values):
        self.values = dict(self.fields)
        for name, value in values.items():
            if name not in self.fields:
                raise TypeError("%s has no %s" % (type(self).__name__, name))
            self.values[name] = value

    def __getattr__(self, name):
        if name.startswith("_") or name not in self.fields:
            raise AttributeError("%s has no %s" % (type(self).__name__, name))
        return self.values[name]


class Vector(Struct):
    fields = dict(x=0.0, y=0.0, z=0.0)

    def __init__(self, x=0.0, y=0.0, z=0.0):
        super().__init__(x=x, y=y, z=z)


class Rotator(Struct):
    fields = dict(roll=0.0, pitch=0.0, yaw=0.0)


class Color(Struct):
    fields = dict(b=0, g=0, r=0, a=0)

    def __init__(self, **values):
        super().__init__(**values)
        for v in self.values.values():
            if not isinstance(v, int) or not 0 <= v <= 255:
                raise TypeError("Color takes bytes")


class Object:
    properties = {}

    def __init__(self):
        self.held = {}

    @classmethod
    def all_properties(cls):
        found = {}
        for base in reversed(cls.__mro__):
            found.update(getattr(base, "properties", {}))
        return found

    def set_editor_property(self, name, value):
        known = self.all_properties()
        if name not in known:
            raise AttributeError("%s has no editor property %s" % (type(self).__name__, name))
        if value is None and known[name] is TextureLightProfile:
            self.held[name] = None
            return
        if not isinstance(value, known[name]) or (known[name] is float and isinstance(value, bool)):
            raise TypeError("%s.%s takes %s, not %r" % (type(self).__name__, name, known[name], value))
        self.held[name] = value

    def modify(self, always_mark_dirty=True):
        self.modified = getattr(self, "modified", 0) + 1
        return True

    def get_editor_property(self, name):
        if name not in self.all_properties():
            raise AttributeError("%s has no editor property %s" % (type(self).__name__, name))
        if name not in self.held and name == "settings":
            self.held[name] = PostProcessSettings()
        if name not in self.held and name in ENGINE_DEFAULTS:
            return ENGINE_DEFAULTS[name]
        return self.held[name]


class TextureLightProfile(Object):
    properties = dict(brightness=float, texture_multiplier=float)


class SceneComponent(Object):
    def set_mobility(self, mobility):
        assert mobility is ComponentMobility.MOVABLE


class LightComponentBase(SceneComponent):
    properties = dict(intensity=float, light_color=Color, cast_shadows=bool)


class LightComponent(LightComponentBase):
    properties = dict(use_temperature=bool, temperature=float, ies_texture=TextureLightProfile,
                      use_ies_brightness=bool, ies_brightness_scale=float)


class LocalLightComponent(LightComponent):
    properties = dict(attenuation_radius=float, intensity_units=Enum)


class PointLightComponent(LocalLightComponent):
    properties = dict(use_inverse_squared_falloff=bool, source_radius=float,
                      soft_source_radius=float, source_length=float)


class SpotLightComponent(PointLightComponent):
    properties = dict(inner_cone_angle=float, outer_cone_angle=float)


class RectLightComponent(LocalLightComponent):
    properties = dict(source_width=float, source_height=float, barn_door_angle=float,
                      barn_door_length=float)


class DirectionalLightComponent(LightComponent):
    properties = dict(light_source_angle=float)


class TextureCube(Object):
    pass


class SkyLightComponent(LightComponentBase):
    properties = dict(source_type=Enum, cubemap=TextureCube, source_cubemap_angle=float,
                      lower_hemisphere_is_black=bool, real_time_capture=bool)

    def recapture_sky(self):
        self.captured = dict(self.held)


class StaticMesh(Object):
    pass


class StaticMeshComponent(SceneComponent):
    def set_static_mesh(self, mesh):
        assert isinstance(mesh, StaticMesh)

    def set_material(self, index, material):
        assert index == 0
        self.material = material


class CameraComponent(SceneComponent):
    properties = dict(field_of_view=float, aspect_ratio=float, constrain_aspect_ratio=bool)


class PostProcessSettings(Object):
    properties = dict(auto_exposure_method=Enum, auto_exposure_bias=float,
                      auto_exposure_apply_physical_camera_exposure=bool, bloom_intensity=float,
                      vignette_intensity=float, tone_curve_amount=float, expand_gamut=float)
    properties.update({"override_" + name: bool for name in list(properties)})


class Name:
    def __init__(self, text=""):
        assert isinstance(text, str)
        self.text = text

    def __str__(self):
        return self.text


class Package(Object):
    def __init__(self, name):
        super().__init__()
        self.name = name

    def get_name(self):
        return self.name


class Actor(Object):
    component = SceneComponent
    properties = dict(tags=list)

    def __init__(self):
        super().__init__()
        self.root = self.component()
        self.held["tags"] = []
        self.label = self.scale = None

    def set_actor_label(self, label):
        assert isinstance(label, str)
        self.label = label

    def get_actor_label(self):
        return self.label

    def set_actor_scale3d(self, scale):
        self.scale = scale

    def get_component_by_class(self, component_class):
        return self.root if isinstance(self.root, component_class) else None

    def get_components_by_class(self, component_class):
        return [self.root] if isinstance(self.root, component_class) else []


def actor(name, component, properties=()):
    return type(name, (Actor,), {"component": component, "properties": dict(properties)})


PointLight = actor("PointLight", PointLightComponent)
SpotLight = actor("SpotLight", SpotLightComponent)
RectLight = actor("RectLight", RectLightComponent)
DirectionalLight = actor("DirectionalLight", DirectionalLightComponent)
SkyLight = actor("SkyLight", SkyLightComponent)
StaticMeshActor = actor("StaticMeshActor", StaticMeshComponent)
CameraActor = actor("CameraActor", CameraComponent)
PostProcessVolume = actor("PostProcessVolume", SceneComponent,
                          dict(unbound=bool, settings=PostProcessSettings))


class LightUnits:
    UNITLESS, CANDELAS, LUMENS, EV, NITS = (Enum(n) for n in
                                            ("UNITLESS", "CANDELAS", "LUMENS", "EV", "NITS"))


ENGINE_DEFAULTS = dict(
    intensity=5000.0, intensity_units=LightUnits.UNITLESS, temperature=6500.0, use_temperature=False,
    attenuation_radius=1000.0, light_color=Color(b=255, g=255, r=255, a=255), ies_texture=None,
    source_radius=0.0, source_width=64.0, source_height=64.0, inner_cone_angle=0.0,
    outer_cone_angle=44.0)


class SkyLightSourceType:
    SLS_CAPTURED_SCENE, SLS_SPECIFIED_CUBEMAP = Enum("SCENE"), Enum("CUBEMAP")


class ComponentMobility:
    STATIC, STATIONARY, MOVABLE = Enum("STATIC"), Enum("STATIONARY"), Enum("MOVABLE")


class AutoExposureMethod:
    AEM_HISTOGRAM, AEM_BASIC, AEM_MANUAL = Enum("H"), Enum("B"), Enum("M")


class MaterialProperty:
    MP_BASE_COLOR, MP_ROUGHNESS, MP_SPECULAR = Enum("base"), Enum("rough"), Enum("spec")


class Material(Object):
    pass


class MaterialFactoryNew(Object):
    pass


class MaterialExpressionConstant(Object):
    properties = dict(r=float)


class AssetImportTask(Object):
    properties = dict(filename=str, destination_path=str, automated=bool, replace_existing=bool,
                      save=bool, imported_object_paths=list)


class Scene:
    """What an editor keeps between runs of scripts: levels of [(actor, location, rotation)], assets,
    the log, and how many transactions were opened and closed."""

    def __init__(self):
        self.levels, self.open, self.unsaved = {"/Game/Stage": []}, "/Game/Stage", []
        self.assets = {"/Engine/BasicShapes/Plane": StaticMesh()}
        self.log, self.warnings, self.errors = [], [], []
        self.transactions, self.in_transaction = [], False
        self.spawned_in_all = 0

    def actors(self):
        return [row[0] for row in self.levels[self.open]]


def build(scene, ies_multiplier):
    """The module of an editor that has this scene."""
    assets = scene.assets
    module = types.ModuleType("unreal")
    for name, value in globals().items():
        if isinstance(value, type) and name not in ("Enum", "Struct", "Object", "Scene"):
            setattr(module, name, value)

    class EditorActorSubsystem:
        def spawn_actor_from_class(self, actor_class, location, rotation):
            assert isinstance(location, Vector) and isinstance(rotation, Rotator)
            assert scene.in_transaction, "spawned outside of a transaction"
            made = actor_class()
            scene.spawned_in_all += 1
            scene.levels[scene.open].append((made, location.values, rotation.values))
            return made

        def get_all_level_actors(self):
            return scene.actors()

        def destroy_actor(self, actor_to_destroy):
            assert scene.in_transaction, "destroyed outside of a transaction"
            rows = scene.levels[scene.open]
            rows[:] = [row for row in rows if row[0] is not actor_to_destroy]
            return True

    class LevelEditorSubsystem:
        def new_level(self, asset_path, is_partitioned_world=False):
            assert asset_path.startswith("/Game/") and asset_path not in scene.levels
            assert "." not in asset_path and " " not in asset_path
            scene.levels[asset_path], scene.open = [], asset_path
            assets[asset_path] = "level"
            return True

        def load_level(self, asset_path):
            scene.open = asset_path
            return asset_path in scene.levels

    class EditorLoadingAndSavingUtils:
        @staticmethod
        def get_dirty_map_packages():
            return [Package(name) for name in scene.unsaved]

    class ScopedEditorTransaction:
        def __init__(self, description):
            assert isinstance(description, str) and description
            self.description = description

        def __enter__(self):
            assert not scene.in_transaction
            scene.in_transaction = True
            return self

        def __exit__(self, kind, value, trace):
            scene.in_transaction = False
            scene.transactions.append(self.description)
            return False

    class Tools:
        def import_asset_tasks(self, tasks):
            for task in tasks:
                assert os.path.exists(task.held["filename"]), task.held["filename"]
                path = task.held["destination_path"] + "/profile%d" % len(assets)
                if task.held["filename"].endswith(".hdr"):
                    assets[path] = TextureCube()
                else:
                    assets[path] = TextureLightProfile()
                    assets[path].held["texture_multiplier"] = ies_multiplier
                assets[path].file = task.held["filename"]
                task.held["imported_object_paths"] = [path]

        def create_asset(self, name, folder, asset_class, factory):
            assert isinstance(factory, MaterialFactoryNew)
            assets[folder + "/" + name] = made = asset_class()
            made.inputs = {}
            return made

    class AssetToolsHelpers:
        @staticmethod
        def get_asset_tools():
            return Tools()

    class EditorAssetLibrary:
        @staticmethod
        def does_asset_exist(path):
            return path in assets

    class MaterialEditingLibrary:
        @staticmethod
        def create_material_expression(material, expression_class):
            made = expression_class()
            made.material = material
            return made

        @staticmethod
        def connect_material_property(expression, output, which):
            expression.material.inputs[which.name] = expression
            return True

        @staticmethod
        def recompile_material(material):
            pass

    module.EditorActorSubsystem = EditorActorSubsystem
    module.LevelEditorSubsystem = LevelEditorSubsystem
    module.EditorLoadingAndSavingUtils = EditorLoadingAndSavingUtils
    module.ScopedEditorTransaction = ScopedEditorTransaction
    module.AssetToolsHelpers = AssetToolsHelpers
    module.EditorAssetLibrary = EditorAssetLibrary
    module.MaterialEditingLibrary = MaterialEditingLibrary
    module.get_editor_subsystem = lambda wanted: wanted()
    module.load_asset = lambda path: assets[path]
    module.log = scene.log.append
    module.log_warning = scene.warnings.append
    module.log_error = scene.errors.append
    return module


def run_in(scene, script, path, ies_multiplier=1.0):
    sys.modules["unreal"] = build(scene, ies_multiplier)
    try:
        exec(compile(script, path, "exec"), {"__file__": path, "__name__": "__main__"})
    finally:
        del sys.modules["unreal"]


def run(script, path, ies_multiplier=1.0):
    """In an empty level: what stands in the level that is open at the end, and what was warned."""
    scene = Scene()
    run_in(scene, script, path, ies_multiplier)
    return scene.levels[scene.open], scene.warnings + scene.errors
