// SPDX-License-Identifier: Apache-2.0
// Stand-ins of the documented Unity types that LightcalImporter.cs names; members it may not use are
// not here. Source: Unity 2022.3 and Unity 6 scripting reference.
using System;

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
        public static ScriptableObject CreateInstance(Type type) { return null; }
    }
    public struct Vector2 { public float x, y; public Vector2(float x, float y) { this.x = x; this.y = y; } }
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }
    public struct Quaternion
    {
        public static Quaternion LookRotation(Vector3 forward, Vector3 upwards) { return new Quaternion(); }
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
        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
        public void SetParent(Transform parent, bool worldPositionStays) { }
    }
    public class Component : Object { }
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
        public GameObject() { }
        public GameObject(string name) { }
        public Transform transform { get { return null; } }
        public T AddComponent<T>() where T : Component { return null; }
        public Component AddComponent(Type type) { return null; }
        public T GetComponent<T>() { return default(T); }
        public Component GetComponent(Type type) { return null; }
        public static GameObject CreatePrimitive(PrimitiveType type) { return null; }
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
#if UNITY_6000_0_OR_NEWER
        public Rendering.LightUnit lightUnit { get; set; }
#endif
    }
    public class Shader : Object { public static Shader Find(string name) { return null; } }
    public class Material : Object
    {
        public Material(Shader shader) { }
        public Color color { get; set; }
        public bool HasProperty(string name) { return true; }
        public void SetColor(string name, Color value) { }
        public void SetFloat(string name, float value) { }
    }
    public static class JsonUtility { public static T FromJson<T>(string json) { return default(T); } }
    public static class Debug
    {
        public static void LogError(object message) { }
        public static void LogWarning(object message) { }
    }
    public static class Application { public static string dataPath { get { return ""; } } }
}

namespace UnityEngine.Rendering
{
    public class RenderPipelineAsset : ScriptableObject { }
    public static class GraphicsSettings
    {
        public static RenderPipelineAsset currentRenderPipeline { get { return null; } }
    }
#if UNITY_6000_0_OR_NEWER
    public enum LightUnit { Lumen, Candela, Lux, Nits, Ev100 }
#endif
}

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method)]
    public class MenuItem : Attribute { public MenuItem(string path) { } }
    public static class EditorUtility
    {
        public static string OpenFilePanel(string title, string directory, string extension) { return ""; }
    }
}
