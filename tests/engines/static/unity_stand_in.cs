// SPDX-License-Identifier: Apache-2.0
// Stand-ins of the documented Unity types that LightcalImporter.cs names; members it may not use are
// not here. Source: Unity 2022.3 and Unity 6 scripting reference.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        public string name { get; set; }
        public static bool operator ==(Object a, Object b) { return ReferenceEquals(a, b); }
        public static bool operator !=(Object a, Object b) { return !ReferenceEquals(a, b); }
        public override bool Equals(object o) { return ReferenceEquals(this, o); }
        public override int GetHashCode() { return 0; }
    }
    public class ScriptableObject : Object
    {
        public static ScriptableObject CreateInstance(Type type) { return (ScriptableObject)Activator.CreateInstance(type); }
    }
    public struct Vector2 { public float x, y; public Vector2(float x, float y) { this.x = x; this.y = y; } }
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }
    public struct Quaternion
    {
        public Vector3 forward, up;
        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards) { return new Quaternion { forward = forward, up = upwards }; }
    }
    public struct Color
    {
        public float r, g, b, a;
        public Color(float r, float g, float b) { this.r = r; this.g = g; this.b = b; a = 1; }
        public Color gamma { get { return this; } }
        public Color linear { get { return this; } }
    }
    public class Transform : Component
    {
        readonly List<Transform> children = new List<Transform>();
        public Transform parent { get; private set; }
        public int childCount { get { return children.Count; } }
        public Transform GetChild(int index) { return children[index]; }
        internal void Leave() { if (parent != null) parent.children.Remove(this); parent = null; }
        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
        public void SetParent(Transform parent, bool worldPositionStays)
        {
            Leave();
            this.parent = parent;
            if (parent != null) parent.children.Add(this);
        }
    }
    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }
        public Transform transform { get { return gameObject.transform; } }
        public Component GetComponent(Type type) { return gameObject.GetComponent(type); }
    }
    public class Behaviour : Component { }
    public class Renderer : Component { public Material sharedMaterial { get; set; } }
    public class Camera : Behaviour
    {
        public float fieldOfView { get; set; }
        public float nearClipPlane { get; set; }
        public bool allowHDR { get; set; }
    }
    public enum PrimitiveType { Sphere, Capsule, Cylinder, Cube, Plane, Quad }
    public class GameObject : Object
    {
        public static readonly List<GameObject> All = new List<GameObject>();
        readonly List<Component> parts = new List<Component>();
        public GameObject() { All.Add(this); transform = new Transform(); transform.gameObject = this; }
        public T[] GetComponentsInChildren<T>(bool includeInactive) where T : Component
        {
            List<T> found = new List<T>();
            foreach (Component part in parts) if (part is T) found.Add((T)part);
            for (int i = 0; i < transform.childCount; i++)
                found.AddRange(transform.GetChild(i).gameObject.GetComponentsInChildren<T>(includeInactive));
            return found.ToArray();
        }
        public GameObject(string name) : this() { this.name = name; }
        public Transform transform { get; private set; }
        public T AddComponent<T>() where T : Component { return (T)AddComponent(typeof(T)); }
        public Component AddComponent(Type type)
        {
            Component part = (Component)Activator.CreateInstance(type);
            part.gameObject = this;
            parts.Add(part);
            return part;
        }
        public T GetComponent<T>() where T : Component { return (T)GetComponent(typeof(T)); }
        public Component GetComponent(Type type) { return parts.Find(part => type.IsInstanceOfType(part)); }
        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            GameObject thing = new GameObject();
            thing.AddComponent<Renderer>();
            return thing;
        }
    }
    public class Texture : Object { }
    public enum TextureFormat { RGBA32 = 4, RGBAHalf = 17, RGBAFloat = 20 }
    public enum CubemapFace { Unknown = -1, PositiveX, NegativeX, PositiveY, NegativeY, PositiveZ, NegativeZ }
    public sealed class Cubemap : Texture
    {
        public readonly Color[][] faces = new Color[6][];
        public int width { get; private set; }
        public TextureFormat format { get; private set; }
        public bool applied;
        public Cubemap(int width, TextureFormat textureFormat, bool mipChain)
        {
            this.width = width;
            format = textureFormat;
        }
        public void SetPixels(Color[] colors, CubemapFace face)
        {
            if (colors.Length != width * width) throw new ArgumentException("SetPixels");
            faces[(int)face] = colors;
        }
        public void Apply(bool updateMipmaps) { applied = true; }
    }
    public enum LightType { Spot, Directional, Point, Area = 3, Rectangle = 3, Disc }
    public enum LightShadows { None, Hard, Soft }
    public class Light : Behaviour
    {
        public LightType type { get; set; }
        public Color color { get; set; }
        public bool useColorTemperature { get; set; }
        public float intensity { get; set; }
        public float range { get; set; }
        public float spotAngle { get; set; }
        public float innerSpotAngle { get; set; }
        public Vector2 areaSize { get; set; }
        public LightShadows shadows { get; set; }
        public Light() { range = 10; spotAngle = 30; innerSpotAngle = 21.80208f; intensity = 1; }
#if UNITY_6000_0_OR_NEWER
        public Rendering.LightUnit lightUnit { get; set; }
#endif
    }
    public class Shader : Object { public static Shader Find(string name) { return new Shader { name = name }; } }
    public class Material : Object
    {
        public Material(Shader shader) { }
        public Color color { get; set; }
        public bool HasProperty(string name) { return true; }
        public void SetColor(string name, Color value) { }
        public void SetFloat(string name, float value) { }
    }
    public static class JsonUtility { public static T FromJson<T>(string json)
        {
            int at = 0;
            return (T)Read(json, ref at, typeof(T));
        }
        // Public fields by their names, as Unity has it; what no field is for is passed over.
        static object Read(string s, ref int at, Type type)
        {
            char c = Next(s, ref at);
            if (c == '{')
            {
                object made = type == null ? null : Activator.CreateInstance(type);
                for (at++; Next(s, ref at) != '}';)
                {
                    if (s[at] == ',') { at++; continue; }
                    string name = Text(s, ref at);
                    Next(s, ref at);
                    at++;
                    var field = type == null ? null : type.GetField(name);
                    object value = Read(s, ref at, field == null ? null : field.FieldType);
                    if (field != null) field.SetValue(made, value);
                }
                at++;
                return made;
            }
            if (c == '[')
            {
                Type item = type == null ? null : type.GetElementType();
                var list = new List<object>();
                for (at++; Next(s, ref at) != ']';)
                {
                    if (s[at] == ',') at++;
                    else list.Add(Read(s, ref at, item));
                }
                at++;
                if (item == null) return null;
                Array array = Array.CreateInstance(item, list.Count);
                for (int i = 0; i < list.Count; i++) array.SetValue(list[i], i);
                return array;
            }
            if (c == '"') return Text(s, ref at);
            int from = at;
            while (at < s.Length && ",]} \n\r\t".IndexOf(s[at]) < 0) at++;
            string word = s.Substring(from, at - from);
            if (type == typeof(bool)) return word == "true";
            return type == typeof(float) ? (object)float.Parse(word, System.Globalization.CultureInfo.InvariantCulture) : null;
        }
        static char Next(string s, ref int at)
        {
            while (char.IsWhiteSpace(s[at])) at++;
            return s[at];
        }
        static string Text(string s, ref int at)
        {
            int from = ++at;
            while (s[at] != '"') at += s[at] == '\\' ? 2 : 1;
            return s.Substring(from, at++ - from);
        } }
    public static class Debug
    {
        public static readonly List<string> Log_ = new List<string>();
        public static void Log(object message) { Log_.Add("" + message); }
        public static readonly List<string> Said = new List<string>();
        public static void LogError(object message) { Said.Add("error: " + message); }
        public static void LogWarning(object message) { Said.Add("warning: " + message); }
    }
    public static class Application { public static string dataPath { get { return ""; } } }
}

namespace UnityEngine.SceneManagement
{
    public struct Scene
    {
        public GameObject[] GetRootGameObjects() { return GameObject.All.FindAll(thing => thing.transform.parent == null).ToArray(); }
    }
    public static class SceneManager { public static Scene GetActiveScene() { return new Scene(); } }
}

namespace UnityEditor.SceneManagement
{
    using UnityEngine;
    public enum NewSceneSetup { EmptyScene, DefaultGameObjects }
    public enum NewSceneMode { Single, Additive }
    public static class EditorSceneManager
    {
        public static bool UserSaves = true;
        public static int Opened;
        public static bool SaveCurrentModifiedScenesIfUserWantsTo() { return UserSaves; }
        public static UnityEngine.SceneManagement.Scene NewScene(NewSceneSetup setup, NewSceneMode mode)
        {
            if (setup != NewSceneSetup.EmptyScene || mode != NewSceneMode.Single) throw new Exception("another scene");
            GameObject.All.Clear();
            Opened++;
            return new UnityEngine.SceneManagement.Scene();
        }
    }
}

namespace UnityEngine.Rendering
{
    public class RenderPipelineAsset : ScriptableObject { }
    public static class GraphicsSettings
    {
        public static RenderPipelineAsset currentRenderPipeline { get; set; }
    }
#if UNITY_6000_0_OR_NEWER
    public enum LightUnit { Lumen, Candela, Lux, Nits, Ev100 }
#endif
}

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method)]
    public class MenuItem : Attribute { public MenuItem(string path) { } }
    // Groups as the editor counts them; what is made or destroyed without it is not undone.
    public static class Undo
    {
        static int group;
        public static readonly HashSet<UnityEngine.Object> Created = new HashSet<UnityEngine.Object>();
        public static readonly HashSet<UnityEngine.Object> Recorded = new HashSet<UnityEngine.Object>();
        public static readonly List<string> Steps = new List<string>();
        static string name = "";
        public static void IncrementCurrentGroup() { group++; }
        public static int GetCurrentGroup() { return group; }
        public static void SetCurrentGroupName(string groupName) { name = groupName; }
        public static void CollapseUndoOperations(int groupIndex)
        {
            if (groupIndex != group || name == "") throw new Exception("another group");
            Steps.Add(name);
        }
        public static UnityEngine.Component AddComponent(UnityEngine.GameObject thing, Type type) { return thing.AddComponent(type); }
        public static void RecordObject(UnityEngine.Object objectToUndo, string label) { Recorded.Add(objectToUndo); }
        public static void RegisterCreatedObjectUndo(UnityEngine.Object objectToUndo, string label) { Created.Add(objectToUndo); }
        public static void DestroyObjectImmediate(UnityEngine.Object objectToUndo)
        {
            UnityEngine.GameObject thing = (UnityEngine.GameObject)objectToUndo;
            while (thing.transform.childCount > 0) DestroyObjectImmediate(thing.transform.GetChild(0).gameObject);
            thing.transform.Leave();
            UnityEngine.GameObject.All.Remove(thing);
        }
    }
    public static class AssetDatabase
    {
        public static readonly List<string> Made = new List<string>();
        public static void CreateAsset(UnityEngine.Object asset, string path)
        {
            if (!path.StartsWith("Assets/")) throw new ArgumentException(path);
            Made.Add(path);
        }
    }
    public static class PrefabUtility
    {
        public static void RecordPrefabInstancePropertyModifications(UnityEngine.Object targetObject) { }
    }
    public static class EditorUtility
    {
        public static string OpenFilePanel(string title, string directory, string extension) { return ""; }
    }
}
