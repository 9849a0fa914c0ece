// Written by lightcal. Not executed in Unity: compiled against stand-ins of its documented types.
// Put this file and the .unity.json into Assets/Editor, then Tools > lightcal > Import preset. The
// lights come into the scene that is open, under one root; imported again, they replace those under
// that root and leave all else as it is; one undo takes them back. NAME.rig.unity.json opens a new
// scene with cards, camera and exposure.
using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.SceneManagement;

namespace Lightcal
{
    [Serializable] public class Emission
    {
        public string type;
        public float intensity, range_m, radius_m, spot_angle_deg, inner_spot_angle_deg;
        public float inner_spot_percent;
        public float area_width_m, area_height_m, angular_diameter_deg;
    }
    [Serializable] public class Place { public string name; public float[] position, forward, up; }
    [Serializable] public class Lamp : Place { public float[] color_linear; public Emission hdrp, urp; }
    [Serializable] public class Card : Place { public float reflectance; }
    [Serializable] public class Eye : Place { public float vertical_fov_deg; }
    [Serializable] public class Exposure { public float ev100, scale; }
    [Serializable] public class Preset
    {
        public string schema, name;
        public Exposure exposure;
        public Lamp[] lights;
        public float side_m;
        public Card[] cards;
        public Eye camera;
    }

    public static class LightcalImporter
    {
        [MenuItem("Tools/lightcal/Import preset")]
        public static void ImportChosen()
        {
            string path = EditorUtility.OpenFilePanel("lightcal preset", Application.dataPath, "json");
            if (!string.IsNullOrEmpty(path)) Import(path);
        }

        public static void Import(string path)
        {
            Preset preset = JsonUtility.FromJson<Preset>(File.ReadAllText(path));
            if (preset == null || preset.schema != "lightcal.unity/1")
            {
                Debug.LogError("lightcal: " + path + " is no lightcal.unity/1 file");
                return;
            }
            if (GraphicsSettings.currentRenderPipeline == null)
            {
                Debug.LogError("lightcal: nothing imported: lights of the built-in render pipeline do " +
                               "not fall off with the square of the distance; open a project of HDRP " +
                               "or URP (Project Settings > Graphics)");
                return;
            }
            Type hdLight = Find("UnityEngine.Rendering.HighDefinition.HDAdditionalLightData");
            bool hdrp = hdLight != null &&
                GraphicsSettings.currentRenderPipeline.GetType().Name.StartsWith("HD");
            bool rig = preset.cards != null && preset.cards.Length > 0;
            if (rig)
            {
                // The rig's scene is its own: the one that is open is saved first, or nothing is done.
                if (!EditorSceneManager.SaveCurrentModifiedScenesIfUserWantsTo()) return;
                EditorSceneManager.NewScene(NewSceneSetup.EmptyScene, NewSceneMode.Single);
            }
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName("lightcal " + preset.name);
            GameObject root = OwnRoot("lightcal " + preset.name);
            RemoveOwnLights(root);
            foreach (Lamp lamp in preset.lights) AddLight(root, lamp, hdrp, hdLight);
            if (rig)
            {
                foreach (Card card in preset.cards) AddCard(root, card, preset.side_m, hdrp);
                AddCamera(root, preset.camera);
                if (hdrp) LockExposure(root, preset.exposure.ev100);
            }
            Undo.CollapseUndoOperations(Undo.GetCurrentGroup());
            Debug.Log("lightcal: " + preset.lights.Length + " lights under \"" + root.name + "\"");
        }

        // Ours by its name among the roots of the scene that is open.
        static GameObject OwnRoot(string name)
        {
            foreach (GameObject thing in SceneManager.GetActiveScene().GetRootGameObjects())
            {
                if (thing.name == name) return thing;
            }
            GameObject root = new GameObject(name);
            Undo.RegisterCreatedObjectUndo(root, name);
            return root;
        }

        // Only what stands right under our root and is a light: what a person put there stays.
        static void RemoveOwnLights(GameObject root)
        {
            List<GameObject> old = new List<GameObject>();
            for (int i = 0; i < root.transform.childCount; i++)
            {
                GameObject thing = root.transform.GetChild(i).gameObject;
                if (thing.GetComponent<Light>() != null) old.Add(thing);
            }
            foreach (GameObject thing in old) Undo.DestroyObjectImmediate(thing);
        }

        static Vector3 V(float[] v) { return new Vector3(v[0], v[1], v[2]); }

        static void Put(GameObject thing, GameObject root, Place place)
        {
            thing.name = place.name;
            thing.transform.SetParent(root.transform, false);
            thing.transform.localPosition = V(place.position);
            thing.transform.localRotation = Quaternion.LookRotation(V(place.forward), V(place.up));
        }

        static void AddLight(GameObject root, Lamp lamp, bool hdrp, Type hdLight)
        {
            GameObject thing = new GameObject();
            Put(thing, root, lamp);
            Light light = thing.AddComponent<Light>();
            Emission e = hdrp ? lamp.hdrp : lamp.urp;
            light.type = (LightType)Enum.Parse(typeof(LightType), e.type);
            // The colour's luminance is in the intensity already: no colour temperature on top.
            light.useColorTemperature = false;
            light.color = new Color(lamp.color_linear[0], lamp.color_linear[1],
                                    lamp.color_linear[2]).gamma;
            light.shadows = LightShadows.Soft;
            if (e.range_m > 0) light.range = e.range_m;
            if (light.type == LightType.Spot)
            {
                light.spotAngle = e.spot_angle_deg;
                light.innerSpotAngle = e.inner_spot_angle_deg;
            }
            if (light.type == LightType.Rectangle)
            {
                light.areaSize = new Vector2(e.area_width_m, e.area_height_m);
            }
            if (hdrp) SetPhysical(thing, light, e, hdLight);
            else light.intensity = e.intensity;
            Undo.RegisterCreatedObjectUndo(thing, lamp.name);
        }

        static string UnitOf(LightType type)
        {
            if (type == LightType.Directional) return "Lux";
            return type == LightType.Rectangle ? "Nits" : "Candela";
        }

        static void SetPhysical(GameObject thing, Light light, Emission e, Type hdLight)
        {
            Component data = thing.GetComponent(hdLight);
            if (data == null) data = thing.AddComponent(hdLight);
            Set(data, "angularDiameter", e.angular_diameter_deg);
            if (e.radius_m > 0) Set(data, "shapeRadius", e.radius_m);
            // HDRP's own inner cone, in percent of the outer angle, 0 by default: Light.innerSpotAngle
            // counts from the version on that has this no more.
            if (light.type == LightType.Spot && hdLight.GetProperty("innerSpotPercent") != null)
            {
                Set(data, "innerSpotPercent", e.inner_spot_percent);
            }
#if UNITY_6000_0_OR_NEWER
            light.lightUnit = (LightUnit)Enum.Parse(typeof(LightUnit), UnitOf(light.type));
            light.intensity = e.intensity;
#else
            if (light.type == LightType.Rectangle) Set(data, "type", "Area");
            if (light.type == LightType.Rectangle) Call(data, "SetAreaLightSize", light.areaSize);
            Type units = Find("UnityEngine.Rendering.HighDefinition.LightUnit");
            MethodInfo set = hdLight.GetMethod("SetIntensity", new Type[] { typeof(float), units });
            set.Invoke(data, new object[] { e.intensity, Enum.Parse(units, UnitOf(light.type)) });
#endif
        }

        static void AddCard(GameObject root, Card card, float side, bool hdrp)
        {
            GameObject thing = GameObject.CreatePrimitive(PrimitiveType.Quad);
            Put(thing, root, card);
            thing.transform.localScale = new Vector3(side, side, 1);
            Shader shader = Shader.Find(hdrp ? "HDRP/Lit" : "Universal Render Pipeline/Simple Lit");
            if (shader == null) shader = Shader.Find("Legacy Shaders/Diffuse");
            Material matt = new Material(shader);
            float r = card.reflectance;
            Color color = new Color(r, r, r).gamma;
            matt.color = color;
            if (matt.HasProperty("_BaseColor")) matt.SetColor("_BaseColor", color);
            if (matt.HasProperty("_Smoothness")) matt.SetFloat("_Smoothness", 0);
            if (matt.HasProperty("_SpecColor")) matt.SetColor("_SpecColor", new Color(0, 0, 0));
            thing.GetComponent<Renderer>().sharedMaterial = matt;
        }

        static void AddCamera(GameObject root, Eye eye)
        {
            GameObject thing = new GameObject();
            Put(thing, root, eye);
            Camera camera = thing.AddComponent<Camera>();
            camera.fieldOfView = eye.vertical_fov_deg;
            camera.nearClipPlane = 0.01f;
            camera.allowHDR = true;
        }

        // A global volume with HDRP's Exposure fixed; by reflection, so that this file compiles in
        // projects without HDRP.
        static void LockExposure(GameObject root, float ev100)
        {
            Type volumeType = Find("UnityEngine.Rendering.Volume");
            Type profileType = Find("UnityEngine.Rendering.VolumeProfile");
            Type exposureType = Find("UnityEngine.Rendering.HighDefinition.Exposure");
            if (volumeType == null || profileType == null || exposureType == null) return;
            GameObject thing = new GameObject("lightcal exposure");
            thing.transform.SetParent(root.transform, false);
            Component volume = thing.AddComponent(volumeType);
            ScriptableObject profile = ScriptableObject.CreateInstance(profileType);
            Set(volume, "isGlobal", true);
            Set(volume, "priority", 100f);
            Set(volume, "sharedProfile", profile);
            object exposure = profileType.GetMethod("Add", new Type[] { typeof(Type), typeof(bool) })
                .Invoke(profile, new object[] { exposureType, true });
            object mode = exposureType.GetField("mode").GetValue(exposure);
            Type modes = mode.GetType().GetProperty("value").PropertyType;
            Set(mode, "value", Enum.Parse(modes, "Fixed"));
            Set(exposureType.GetField("fixedExposure").GetValue(exposure), "value", ev100);
        }

        static Type Find(string name)
        {
            foreach (Assembly assembly in AppDomain.CurrentDomain.GetAssemblies())
            {
                Type type = assembly.GetType(name);
                if (type != null) return type;
            }
            return null;
        }

        static void Set(object target, string name, object value)
        {
            PropertyInfo property = target.GetType().GetProperty(name);
            FieldInfo field = target.GetType().GetField(name);
            Type type = property != null ? property.PropertyType : field != null ? field.FieldType : null;
            if (type != null && type.IsEnum && value is string) value = Enum.Parse(type, (string)value);
            if (property != null) property.SetValue(target, value, null);
            else if (field != null) field.SetValue(target, value);
            else Debug.LogWarning("lightcal: " + target.GetType().Name + " has no " + name);
        }

        static void Call(object target, string name, object argument)
        {
            MethodInfo method = target.GetType().GetMethod(name, new Type[] { argument.GetType() });
            if (method != null) method.Invoke(target, new object[] { argument });
        }
    }
}
