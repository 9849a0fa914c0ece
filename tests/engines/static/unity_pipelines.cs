// SPDX-License-Identifier: Apache-2.0
// HDRP's documented members, and no other: a name the importer makes up is said by Debug.LogWarning,
// which fails the gate. HDRP_17_3 has no inner cone of its own any more. Then a Main that imports a
// preset and prints what every light holds.
// Source: HDRP 14 scripting API (HDAdditionalLightData: "We don't use Light.innerSpotAngle").
using System;
using System.Globalization;
using UnityEngine;
using UnityEngine.Rendering;

namespace UnityEngine.Rendering
{
    public class VolumeProfile : ScriptableObject
    {
        public object Add(Type type, bool overrides) { return Activator.CreateInstance(type); }
    }
    public class Volume : Component
    {
        public bool isGlobal;
        public float priority;
        public VolumeProfile sharedProfile;
    }
}

namespace UnityEngine.Rendering.HighDefinition
{
    public class HDRenderPipelineAsset : RenderPipelineAsset { }
#if !UNITY_6000_0_OR_NEWER
    public enum LightUnit { Lumen, Candela, Lux, Nits, Ev100 }
#endif
    public enum HDLightType { Spot, Directional, Point, Area }
    public enum ExposureMode { Fixed, Automatic }
    public class ModeParameter { public ExposureMode value { get; set; } }
    public class FloatParameter { public float value { get; set; } }
    public class Exposure
    {
        public ModeParameter mode = new ModeParameter();
        public FloatParameter fixedExposure = new FloatParameter();
    }
    public class HDAdditionalLightData : Component
    {
        public float angularDiameter { get; set; }
        public float shapeRadius { get; set; }
#if !HDRP_17_3
        public float innerSpotPercent { get; set; }
#endif
#if !UNITY_6000_0_OR_NEWER
        public HDLightType type { get; set; }
        public float intensity { get; private set; }
        public LightUnit lightUnit { get; private set; }
        public Vector2 size { get; private set; }
        public void SetIntensity(float intensity, LightUnit unit) { this.intensity = intensity; lightUnit = unit; }
        public void SetAreaLightSize(Vector2 size) { this.size = size; }
#endif
    }
}

namespace UnityEngine.Rendering.Universal
{
    public class UniversalRenderPipelineAsset : RenderPipelineAsset { }
}

public static class RunImporter
{
    static string N(float v) { return v.ToString("R", CultureInfo.InvariantCulture); }

    public static int Main(string[] words)
    {
        if (words[1] == "hdrp")
            GraphicsSettings.currentRenderPipeline = new UnityEngine.Rendering.HighDefinition.HDRenderPipelineAsset();
        if (words[1] == "urp")
            GraphicsSettings.currentRenderPipeline = new UnityEngine.Rendering.Universal.UniversalRenderPipelineAsset();
        Lightcal.LightcalImporter.Import(words[0]);
        foreach (string said in Debug.Said) Console.WriteLine("said " + said);
        foreach (GameObject thing in GameObject.All)
        {
            Light light = thing.GetComponent<Light>();
            if (light == null) continue;
            float intensity = light.intensity, percent = -1;
            string unit = "";
            var data = thing.GetComponent<UnityEngine.Rendering.HighDefinition.HDAdditionalLightData>();
            if (data != null)
            {
#if UNITY_6000_0_OR_NEWER
                unit = light.lightUnit.ToString();
#else
                intensity = data.intensity;
                unit = data.lightUnit.ToString();
#endif
#if !HDRP_17_3
                percent = data.innerSpotPercent;
#endif
            }
            Console.WriteLine("light\t" + thing.name + "\t" + light.type + "\t" + N(intensity) + "\t" + unit + "\t" +
                N(light.spotAngle) + "\t" + N(light.innerSpotAngle) + "\t" + N(percent) + "\t" + N(light.range));
        }
        return 0;
    }
}
