// Written by lightcal. Not executed in Unity: compiled against stand-ins of its documented types.
// Put this file and the .unity.json into Assets/Editor, then Tools > lightcal > Import preset. The
// lights come into the scene that is open, under one root; imported again, they replace those under
// that root and leave all else as it is; one undo takes them back. NAME.rig.unity.json opens a new
// scene with cards, camera and exposure. A file exported with --into makes nothing: it sets lights
// that are there, by name, or refuses.
using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEditor;
using UnityEditor.SceneManagement;
using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.SceneManagement;

namespace Lightcal
{
    [Serializable] public class Emission
    {
        public string type, substituted;
        public float intensity, range_m, radius_m, spot_angle_deg, inner_spot_angle_deg;
        public float inner_spot_percent;
        public float area_width_m, area_height_m, angular_diameter_deg;
    }
    [Serializable] public class Place { public string name; public float[] position, forward, up; }
    [Serializable] public class Lamp : Place
    {
        public float[] color_linear;
        public Emission hdrp, urp;
        public string picture;  // of a measured panorama: texels in cd/m2
        public float upward_lx;
    }
    [Serializable] public class Card : Place { public float reflectance; }
    [Serializable] public class Eye : Place { public float vertical_fov_deg; }
    [Serializable] public class Exposure { public float ev100, scale; }
    [Serializable] public class Row { public string lamp, @object; }
    [Serializable] public class Preset
    {
        public string schema, name;
        public Exposure exposure;
        public Lamp[] lights;
        public Row[] into;
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
            if (preset.into != null && preset.into.Length > 0)
            {
                SetLightsThatAreThere(preset, hdrp, hdLight);
                return;
            }
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
            foreach (Lamp lamp in preset.lights)
            {
                if (hdrp && lamp.hdrp.type == "Sky") AddSky(root, lamp, Path.GetDirectoryName(path));
                else AddLight(root, lamp, hdrp, hdLight);
            }
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
                if (thing.GetComponent<Light>() != null || thing.name.EndsWith(kSkyMark)) old.Add(thing);
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
            light.shadows = LightShadows.Soft;
            if (hdrp && thing.GetComponent(hdLight) == null) thing.AddComponent(hdLight);
            SetFigures(light, lamp, e, hdrp, hdLight);
            // What HDRP has no light for the export has said; this is what URP has none for besides.
            if (!string.IsNullOrEmpty(e.substituted) && e.substituted != lamp.hdrp.substituted)
            {
                bool sky = lamp.hdrp.type == "Sky";
                Debug.LogWarning("lightcal: " + lamp.name + ": " + e.substituted +
                                 (sky ? "; the picture lights a project of HDRP, not of URP" : ""));
            }
            Undo.RegisterCreatedObjectUndo(thing, lamp.name);
        }

        // Type, intensity, colour, cone and size: a light of another type shows another lamp, and a cone
        // that stays cuts what shines beyond it.
        static void SetFigures(Light light, Lamp lamp, Emission e, bool hdrp, Type hdLight)
        {
            light.type = (LightType)Enum.Parse(typeof(LightType), e.type);
            // The colour's luminance is in the intensity already: no colour temperature on top.
            light.useColorTemperature = false;
            light.color = new Color(lamp.color_linear[0], lamp.color_linear[1],
                                    lamp.color_linear[2]).gamma;
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
            if (hdrp) SetPhysical(light, e, hdLight);
            else light.intensity = e.intensity;
        }

        // * any letters, ? one; all else as it is.
        static bool Matches(string pattern, string name)
        {
            string spelled = Regex.Escape(pattern).Replace("\\*", ".*").Replace("\\?", ".");
            return Regex.IsMatch(name, "\\A(?:" + spelled + ")\\z", RegexOptions.Singleline);
        }

        static string Figures(Light light, bool hdrp, Type hdLight)
        {
            Color c = light.color;
            string text = light.type + ", intensity " + light.intensity;
            if (hdrp)
            {
#if UNITY_6000_0_OR_NEWER
                text += " " + light.lightUnit;
#else
                Component data = light.GetComponent(hdLight);
                if (data != null) text = light.type + ", intensity " + Get(data, "intensity") + " " + Get(data, "lightUnit");
#endif
            }
            text += ", colour " + c.r + " " + c.g + " " + c.b + ", range " + light.range;
            if (light.useColorTemperature) text += ", with a temperature";
            if (light.type == LightType.Spot)
            {
                text += ", cone " + light.innerSpotAngle + " to " + light.spotAngle + " deg";
            }
            return text;
        }

        // What keeps this light from being set, and what to do; "" = nothing.
        static string WhyNot(Light light, Lamp lamp, Emission e, bool hdrp)
        {
            bool sun = light.type == LightType.Directional;
            if (sun != (e.type == "Directional"))
            {
                return "is " + light.type + ", and \"" + lamp.name + "\" was measured in " +
                    (sun ? "candela: make it a point or a spot light" : "lux: make it directional");
            }
            bool known = sun || light.type == LightType.Point || light.type == LightType.Spot ||
                (light.type == LightType.Rectangle && hdrp);
            return known ? "" : "is " + light.type + ", which this pipeline gives no candela: make it " +
                "a point or a spot light";
        }

        // The rows of the export's --into; all of them, or nothing.
        static void SetLightsThatAreThere(Preset preset, bool hdrp, Type hdLight)
        {
            List<Light> there = new List<Light>();
            foreach (GameObject root in SceneManager.GetActiveScene().GetRootGameObjects())
            {
                there.AddRange(root.GetComponentsInChildren<Light>(true));
            }
            List<string> problems = new List<string>();
            Dictionary<Light, Lamp> taken = new Dictionary<Light, Lamp>();
            foreach (Row row in preset.into)
            {
                Lamp lamp = Array.Find(preset.lights, one => one.name == row.lamp);
                List<Light> found = there.FindAll(one => Matches(row.@object, one.gameObject.name));
                if (found.Count == 0)
                {
                    string names = string.Join(", ", there.ConvertAll(one => one.gameObject.name).ToArray());
                    problems.Add("no light of the scene is called \"" + row.@object + "\"; it has " +
                                 (names == "" ? "none" : names));
                }
                foreach (Light light in found)
                {
                    string name = "\"" + light.gameObject.name + "\" ";
                    if (taken.ContainsKey(light) && taken[light] != lamp)
                    {
                        problems.Add(name + "would get two lamps, \"" + taken[light].name + "\" and \"" +
                                     lamp.name + "\": leave one of the lines");
                    }
                    taken[light] = lamp;
                    string why = WhyNot(light, lamp, hdrp ? lamp.hdrp : lamp.urp, hdrp);
                    if (why != "") problems.Add(name + why);
                }
            }
            foreach (string problem in problems) Debug.LogError("lightcal: nothing set: " + problem);
            if (problems.Count > 0) return;
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName("lightcal " + preset.name);
            foreach (KeyValuePair<Light, Lamp> pair in taken)
            {
                Light light = pair.Key;
                Emission e = hdrp ? pair.Value.hdrp : pair.Value.urp;
                string before = Figures(light, hdrp, hdLight);
                LightType was = light.type;
                List<UnityEngine.Object> parts = new List<UnityEngine.Object> { light };
                if (hdrp)
                {
                    Component data = light.GetComponent(hdLight);
                    if (data == null) data = Undo.AddComponent(light.gameObject, hdLight);
                    parts.Add(data);
                }
                foreach (UnityEngine.Object part in parts) Undo.RecordObject(part, "lightcal " + preset.name);
                SetFigures(light, pair.Value, e, hdrp, hdLight);
                foreach (UnityEngine.Object part in parts)
                {
                    PrefabUtility.RecordPrefabInstancePropertyModifications(part);
                }
                Debug.Log("lightcal: " + light.gameObject.name + ": " + before + " -> " +
                          Figures(light, hdrp, hdLight) + "   (" + pair.Value.name + ")");
                if (was == LightType.Point && light.type != was)
                {
                    Debug.LogWarning("lightcal: " + light.gameObject.name + " shone all round, and shines " +
                                     "along its forward axis now: see that it aims");
                }
            }
            Undo.CollapseUndoOperations(Undo.GetCurrentGroup());
        }

        static string UnitOf(LightType type)
        {
            if (type == LightType.Directional) return "Lux";
            return type == LightType.Rectangle ? "Nits" : "Candela";
        }

        static void SetPhysical(Light light, Emission e, Type hdLight)
        {
            Component data = light.GetComponent(hdLight);
            if (light.type == LightType.Directional) Set(data, "angularDiameter", e.angular_diameter_deg);
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
            Set(data, "type", light.type == LightType.Rectangle ? "Area" : e.type);
            if (light.type == LightType.Rectangle) Call(data, "SetAreaLightSize", light.areaSize);
            Type units = Find("UnityEngine.Rendering.HighDefinition.LightUnit");
            MethodInfo set = hdLight.GetMethod("SetIntensity", new Type[] { typeof(float), units });
            set.Invoke(data, new object[] { e.intensity, Enum.Parse(units, UnitOf(light.type)) });
#endif
        }

        const string kSkyMark = " (lightcal sky)";

        // A measured panorama as HDRP's HDRI sky: a cubemap of cd/m2 made here, face by face, so that no
        // importer decides which way round it stands; in lux mode with the picture's own lux on a plane
        // that faces up, which multiplies by 1 (SkyRenderer.GetSkyIntensity: desired over upper).
        static void AddSky(GameObject root, Lamp lamp, string folder)
        {
            Type volumeType = Find("UnityEngine.Rendering.Volume");
            Type profileType = Find("UnityEngine.Rendering.VolumeProfile");
            Type skyType = Find("UnityEngine.Rendering.HighDefinition.HDRISky");
            Type visualType = Find("UnityEngine.Rendering.HighDefinition.VisualEnvironment");
            Cubemap cubemap = ReadPanorama(Path.Combine(folder, lamp.picture));
            if (cubemap == null || volumeType == null || skyType == null || visualType == null)
            {
                Debug.LogError("lightcal: no sky made of " + lamp.picture + ": put it beside the .unity.json");
                return;
            }
            AssetDatabase.CreateAsset(cubemap, "Assets/" + Path.GetFileNameWithoutExtension(lamp.picture) +
                                      ".cubemap");
            GameObject thing = new GameObject(lamp.name + kSkyMark);
            thing.transform.SetParent(root.transform, false);
            Component volume = thing.AddComponent(volumeType);
            ScriptableObject profile = ScriptableObject.CreateInstance(profileType);
            Set(volume, "isGlobal", true);
            Set(volume, "priority", 100f);
            Set(volume, "sharedProfile", profile);
            MethodInfo add = profileType.GetMethod("Add", new Type[] { typeof(Type), typeof(bool) });
            object visual = add.Invoke(profile, new object[] { visualType, true });
            SetParameter(visual, "skyType", 1);  // SkyType.HDRI
            object sky = add.Invoke(profile, new object[] { skyType, true });
            SetParameter(sky, "hdriSky", cubemap);
            SetParameter(sky, "rotation", 0f);
            SetParameter(sky, "skyIntensityMode", "Lux");
            SetParameter(sky, "upperHemisphereLuxValue", lamp.upward_lx);
            SetParameter(sky, "desiredLuxValue", lamp.upward_lx);
            Undo.RegisterCreatedObjectUndo(thing, lamp.name);
        }

        static void SetParameter(object part, string name, object value)
        {
            FieldInfo field = part.GetType().GetField(name);
            if (field == null) Debug.LogWarning("lightcal: " + part.GetType().Name + " has no " + name);
            else Set(field.GetValue(part), "value", value);
        }

        // A Radiance picture as lightcal writes it: from its upper left, each row in four packed planes.
        static Cubemap ReadPanorama(string path)
        {
            if (!File.Exists(path)) return null;
            byte[] bytes = File.ReadAllBytes(path);
            int at = 0, width = 0, height = 0;
            for (string line = Line(bytes, ref at); width == 0 && at < bytes.Length; line = Line(bytes, ref at))
            {
                Match size = Regex.Match(line, "^-Y (\\d+) \\+X (\\d+)$");
                if (!size.Success) continue;
                height = int.Parse(size.Groups[1].Value);
                width = int.Parse(size.Groups[2].Value);
                break;
            }
            if (width == 0) return null;
            byte[] rgbe = new byte[4 * width * height];
            for (int y = 0; y < height; y++)
            {
                if (!ReadRow(bytes, ref at, rgbe, y, width)) return null;
            }
            int edge = 16;
            while (edge < 1024 && 4 * edge < width) edge *= 2;
            Cubemap cubemap = new Cubemap(edge, TextureFormat.RGBAHalf, true);
            for (int face = 0; face < 6; face++)
            {
                Color[] pixels = new Color[edge * edge];
                for (int i = 0; i < pixels.Length; i++)
                {
                    double u = 2.0 * (i % edge + 0.5) / edge - 1, v = 2.0 * (i / edge + 0.5) / edge - 1;
                    pixels[i] = MeanTowards(rgbe, width, height, face, u, v, 2.0 / edge);
                }
                cubemap.SetPixels(pixels, (CubemapFace)face);
            }
            cubemap.Apply(true);
            return cubemap;
        }

        // Red, green, blue and exponents of a row, each as runs (over 128) and as they are; or pixel by pixel.
        static bool ReadRow(byte[] bytes, ref int at, byte[] rgbe, int y, int width)
        {
            bool packed = at + 4 <= bytes.Length && bytes[at] == 2 && bytes[at + 1] == 2 && bytes[at + 2] < 128;
            if (!packed)
            {
                if (at + 4 * width > bytes.Length) return false;
                Array.Copy(bytes, at, rgbe, 4 * y * width, 4 * width);
                at += 4 * width;
                return true;
            }
            at += 4;
            for (int channel = 0; channel < 4; channel++)
            {
                for (int x = 0; x < width;)
                {
                    if (at + 2 > bytes.Length) return false;
                    int count = bytes[at++];
                    bool run = count > 128;
                    if (run) count -= 128;
                    if (count == 0 || x + count > width || at + (run ? 1 : count) > bytes.Length) return false;
                    for (int i = 0; i < count; i++, x++)
                    {
                        rgbe[4 * (y * width + x) + channel] = run ? bytes[at] : bytes[at++];
                    }
                    if (run) at++;
                }
            }
            return true;
        }

        static string Line(byte[] bytes, ref int at)
        {
            int start = at;
            while (at < bytes.Length && bytes[at] != 10) at++;
            at++;
            return System.Text.Encoding.ASCII.GetString(bytes, start, Math.Min(at, bytes.Length) - start - 1);
        }

        // The mean over a face's pixel, 4 x 4 places: all of a picture that is not much finer.
        static Color MeanTowards(byte[] rgbe, int width, int height, int face, double u, double v, double step)
        {
            double r = 0, g = 0, b = 0;
            for (int i = 0; i < 16; i++)
            {
                double s = u + step * ((i % 4 + 0.5) / 4 - 0.5), t = v + step * ((i / 4 + 0.5) / 4 - 0.5);
                double x = s, y = -t, z = 1;  // +Z; then +X -X +Y -Y -Z
                if (face == 0) { x = 1; z = -s; }
                if (face == 1) { x = -1; z = s; }
                if (face == 2) { y = 1; z = t; }
                if (face == 3) { y = -1; z = -t; }
                if (face == 5) { x = -s; z = -1; }
                // The middle of the picture looks along +Z, its right side is +X.
                int column = (int)((0.5 + Math.Atan2(x, z) / (2 * Math.PI)) * width);
                int row = (int)(Math.Acos(y / Math.Sqrt(x * x + y * y + z * z)) / Math.PI * height);
                int pixel = 4 * (Math.Min(row, height - 1) * width + Math.Min(column, width - 1));
                double scale = rgbe[pixel + 3] == 0 ? 0 : Math.Pow(2, rgbe[pixel + 3] - 136) / 16;
                r += scale * rgbe[pixel];
                g += scale * rgbe[pixel + 1];
                b += scale * rgbe[pixel + 2];
            }
            const double most = 65504;  // of half floats
            return new Color((float)Math.Min(r, most), (float)Math.Min(g, most), (float)Math.Min(b, most));
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

        static object Get(object target, string name)
        {
            PropertyInfo property = target.GetType().GetProperty(name);
            return property == null ? null : property.GetValue(target, null);
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
