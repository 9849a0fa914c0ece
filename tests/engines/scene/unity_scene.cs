// SPDX-License-Identifier: Apache-2.0
// A person's scene of twelve lamps, then imports one after the other; after each a picture of all that
// stands in the scene, what was said, and the steps of the editor's undo. "-" beside a light: changed
// without Undo.RecordObject or made without Undo.RegisterCreatedObjectUndo.
using System;
using System.Collections.Generic;
using System.Globalization;
using UnityEditor;
using UnityEngine;
using UnityEngine.Rendering;

public static class PersonsScene
{
    static string N(float v) { return v.ToString("R", CultureInfo.InvariantCulture); }
    static string N(Vector3 v) { return N(v.x) + " " + N(v.y) + " " + N(v.z); }

    static string Picture(GameObject thing)
    {
        string text = thing.name + " under " + (thing.transform.parent == null ? "-" : thing.transform.parent.gameObject.name) +
            " at " + N(thing.transform.localPosition);
        Light light = thing.GetComponent<Light>();
        if (light == null) return text;
        text += " " + light.type + " " + N(light.intensity) + " " + N(light.color.r) + " " + N(light.color.g) + " " +
            N(light.color.b) + " " + light.useColorTemperature + " " + N(light.range) + " " + N(light.spotAngle) + " " +
            N(light.innerSpotAngle) + " " + N(light.areaSize.x) + " " + N(light.areaSize.y) + " " + light.shadows;
        var data = thing.GetComponent<UnityEngine.Rendering.HighDefinition.HDAdditionalLightData>();
        if (data != null) text += " hd " + N(data.angularDiameter) + " " + N(data.shapeRadius);
#if UNITY_6000_0_OR_NEWER
        text += " " + light.lightUnit;
#else
        if (data != null) text += " " + N(data.intensity) + " " + data.lightUnit;
#endif
        return text;
    }

    static GameObject Person(string name, LightType type, int number)
    {
        GameObject thing = new GameObject(name);
        thing.transform.localPosition = new Vector3(number, 2, 0);
        Light light = thing.AddComponent<Light>();
        light.type = type;
        light.intensity = 600 + number;
        light.color = new Color(0.9f, 0.5f, 0.1f);
        light.useColorTemperature = true;
        light.areaSize = new Vector2(2, 0.5f);
        return thing;
    }

    public static int Main(string[] words)
    {
        GraphicsSettings.currentRenderPipeline = words[0] == "hdrp"
            ? (RenderPipelineAsset)new UnityEngine.Rendering.HighDefinition.HDRenderPipelineAsset()
            : new UnityEngine.Rendering.Universal.UniversalRenderPipelineAsset();
        GameObject room = new GameObject("Room");
        for (int i = 0; i < 12; i++)
        {
            LightType type = i % 3 == 0 ? LightType.Point : i % 3 == 1 ? LightType.Spot : LightType.Rectangle;
            if (words[0] != "hdrp" && i % 3 == 2) type = LightType.Point;
            Person("PropLamp_" + i, type, i).transform.SetParent(room.transform, false);
        }
        Person("Sun", LightType.Directional, 20);
        new GameObject("Main Camera").AddComponent<Camera>();
        for (int w = 1; w <= words.Length; w++)
        {
            List<string> before = new List<string>();
            foreach (GameObject thing in GameObject.All) before.Add(Picture(thing));
            foreach (string one in before) Console.WriteLine("has\t" + (w - 1) + "\t" + one);
            if (w == words.Length) break;
            List<GameObject> were = new List<GameObject>(GameObject.All);
            Undo.Recorded.Clear();
            Undo.Created.Clear();
            Debug.Said.Clear();
            Debug.Log_.Clear();
            Undo.Steps.Clear();
            Lightcal.LightcalImporter.Import(words[w]);
            foreach (GameObject thing in GameObject.All)
            {
                Light light = thing.GetComponent<Light>();
                int at = were.IndexOf(thing);
                bool told = at < 0 ? Undo.Created.Contains(thing) || light == null
                                   : Picture(thing) == before[at] || Undo.Recorded.Contains(light);
                if (!told) Console.WriteLine("untold\t" + w + "\t" + thing.name);
            }
            foreach (string said in Debug.Said) Console.WriteLine("said\t" + w + "\t" + said);
            foreach (string said in Debug.Log_) Console.WriteLine("log\t" + w + "\t" + said);
            foreach (string step in Undo.Steps) Console.WriteLine("undo\t" + w + "\t" + step);
        }
        return 0;
    }
}
