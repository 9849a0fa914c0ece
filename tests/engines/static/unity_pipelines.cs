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
        public readonly System.Collections.Generic.List<object> parts = new System.Collections.Generic.List<object>();
        public object Add(Type type, bool overrides)
        {
            parts.Add(Activator.CreateInstance(type));
            return parts[parts.Count - 1];
        }
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
    public enum SkyIntensityMode { Exposure, Lux, Multiplier }
    public class IntParameter { public int value { get; set; } }
    public class CubemapParameter { public Texture value { get; set; } }
    public class SkyIntensityParameter { public SkyIntensityMode value { get; set; } }
    public class VisualEnvironment { public IntParameter skyType = new IntParameter(); }
    public class HDRISky
    {
        public CubemapParameter hdriSky = new CubemapParameter();
        public FloatParameter rotation = new FloatParameter();
        public SkyIntensityParameter skyIntensityMode = new SkyIntensityParameter();
        public FloatParameter exposure = new FloatParameter();
        public FloatParameter multiplier = new FloatParameter { value = 1 };
        public FloatParameter upperHemisphereLuxValue = new FloatParameter { value = 1 };
        public FloatParameter desiredLuxValue = new FloatParameter { value = 20000 };
        // SkyRenderer.GetSkyIntensity
        public double Intensity()
        {
            if (skyIntensityMode.value == SkyIntensityMode.Lux)
                return desiredLuxValue.value / upperHemisphereLuxValue.value;
            return skyIntensityMode.value == SkyIntensityMode.Multiplier ? multiplier.value : Math.Pow(2, exposure.value);
        }
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

    // What a white card facing right, left, up, down, forward and back gets of the sky, by the cubemap's
    // faces as Direct3D has them (+X: -Z to the right, down the rows): seen from inside, left-handed.
    static void SayIrradiance(Volume volume)
    {
        UnityEngine.Rendering.HighDefinition.HDRISky sky = null;
        bool shown = false;
        foreach (object part in volume.sharedProfile.parts)
        {
            var visual = part as UnityEngine.Rendering.HighDefinition.VisualEnvironment;
            if (visual != null) shown = visual.skyType.value == 1;
            if (part is UnityEngine.Rendering.HighDefinition.HDRISky) sky = (UnityEngine.Rendering.HighDefinition.HDRISky)part;
        }
        if (sky == null || !shown) return;
        var cube = (Cubemap)sky.hdriSky.value;
        double[][] looks = { new double[] { 1, 0, 0 }, new double[] { -1, 0, 0 }, new double[] { 0, 1, 0 },
                             new double[] { 0, -1, 0 }, new double[] { 0, 0, 1 }, new double[] { 0, 0, -1 } };
        double[][] rights = { new double[] { 0, 0, -1 }, new double[] { 0, 0, 1 }, new double[] { 1, 0, 0 },
                              new double[] { 1, 0, 0 }, new double[] { 1, 0, 0 }, new double[] { -1, 0, 0 } };
        double[][] downs = { new double[] { 0, -1, 0 }, new double[] { 0, -1, 0 }, new double[] { 0, 0, 1 },
                             new double[] { 0, 0, -1 }, new double[] { 0, -1, 0 }, new double[] { 0, -1, 0 } };
        double[] lit = new double[18];
        int n = cube.width;
        for (int face = 0; face < 6; face++)
        for (int i = 0; i < n * n; i++)
        {
            double u = 2 * (i % n + 0.5) / n - 1, v = 2 * (i / n + 0.5) / n - 1;
            double omega = 4.0 / n / n / Math.Pow(1 + u * u + v * v, 1.5);
            double length = Math.Sqrt(1 + u * u + v * v);
            Color c = cube.faces[face][i];
            for (int way = 0; way < 6; way++)
            {
                double cosine = 0;
                for (int k = 0; k < 3; k++)
                    cosine += looks[way][k] * (looks[face][k] + u * rights[face][k] + v * downs[face][k]) / length;
                if (cosine <= 0) continue;
                double weight = omega * cosine * sky.Intensity();
                lit[3 * way] += weight * c.r;
                lit[3 * way + 1] += weight * c.g;
                lit[3 * way + 2] += weight * c.b;
            }
        }
        string text = "sky\t" + sky.skyIntensityMode.value + "\t" + cube.format + "\t" + cube.applied + "\t" +
            sky.rotation.value;
        foreach (double value in lit) text += "\t" + value.ToString("R", CultureInfo.InvariantCulture);
        Console.WriteLine(text);
    }

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
            var volume = thing.GetComponent<Volume>();
            if (volume != null && volume.sharedProfile != null) SayIrradiance(volume);
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
