# Written by lightcal: figures for lights that stand in the scene which is open in Godot 4.2 or later,
# with physical light units (Project Settings: rendering/lights_and_shadows). Not executed by this run.
# Put this file into the project, open it in the script editor, then File > Run (Ctrl+Shift+X). It sets
# lights by their names, or refuses; it moves and makes none; one undo takes it back.
@tool
extends EditorScript

const DATA = @DATA@


# * any letters, ? one; all else as it is.
static func matches(pattern: String, text: String) -> bool:
	if pattern.is_empty():
		return text.is_empty()
	if pattern[0] == "*":
		for i in text.length() + 1:
			if matches(pattern.substr(1), text.substr(i)):
				return true
		return false
	if text.is_empty() or (pattern[0] != "?" and pattern[0] != text[0]):
		return false
	return matches(pattern.substr(1), text.substr(1))


static func lamp_of(name: String) -> Dictionary:
	for lamp in DATA.lights:
		if lamp.name == name:
			return lamp
	return {}


# What keeps this light from being set, and what to do; "" = nothing.
static func why_not(root: Node, light: Light3D, lamp: Dictionary) -> String:
	var sun := light is DirectionalLight3D
	if sun != (lamp.type == "DirectionalLight3D"):
		return "is a %s, and \"%s\" was measured in %s; name a light of the other kind" % [
			light.get_class(), lamp.name, "candela" if sun else "lux"]
	if not (light is OmniLight3D or light is SpotLight3D or sun):
		return "is a %s; an OmniLight3D or a SpotLight3D has candela" % light.get_class()
	if light != root and light.owner != root:
		return "belongs to a scene that is instanced here: open that scene and run this there"
	return ""


# [property, value] of this light: intensity, colour, cone and size as far as the lamp has them.
static func figures_for(light: Light3D, lamp: Dictionary) -> Array:
	var rows := [["light_energy", 1.0], ["light_temperature", lamp.light_temperature],
		["light_color", Color(lamp.light_color[0], lamp.light_color[1], lamp.light_color[2])]]
	if light is DirectionalLight3D:
		return rows + [["light_intensity_lux", lamp.light_intensity_lux],
			["light_angular_distance", lamp.light_angular_distance]]
	# Lumens are 4 pi cd of an omni and pi cd of a spot, whatever its cone; on its axis a spot keeps
	# 1 - .0001^(1 / attenuation) of them. A lamp that shines all round takes a wide and flat spot, for
	# the cone that was there would cut it; at 90 degrees some versions of 4 cull a spot wrongly.
	var spot := light is SpotLight3D
	var prefix := "spot" if spot else "omni"
	var sr := 4.0 * PI
	var attenuation: float = lamp.get("spot_angle_attenuation", 0.01)
	if spot:
		sr = PI / (1.0 - pow(0.0001, 1.0 / attenuation))
	rows += [["light_intensity_lumens", lamp.candela * sr],
		[prefix + "_range", lamp.range], [prefix + "_attenuation", 2.0]]
	if lamp.get("light_size", 0.0) > 0.0:
		rows.append(["light_size", lamp.light_size])
	if spot:
		rows += [["spot_angle", lamp.get("spot_angle", 89.0)], ["spot_angle_attenuation", attenuation]]
	return rows


# What this light shows otherwise than the lamp; "" = nothing.
static func strays(light: Light3D, lamp: Dictionary) -> String:
	if light is SpotLight3D and lamp.type == "OmniLight3D":
		return "is a spot, dark beyond 89 degrees from its aim; an OmniLight3D shows all of \"%s\"" % lamp.name
	if light is OmniLight3D and lamp.type == "SpotLight3D":
		return "has no cone: right on the axis of \"%s\" alone; a SpotLight3D has one" % lamp.name
	return ""


# {"problems": [text], "taken": {light: lamp}}
static func plan(root: Node) -> Dictionary:
	var lights: Array = root.find_children("*", "Light3D", true, false)
	if root is Light3D:
		lights.push_front(root)
	var names := lights.map(func(light): return String(light.name))
	var problems: Array[String] = []
	var taken := {}
	for row in DATA.into:
		var found := lights.filter(func(light): return matches(row.object, String(light.name)))
		if found.is_empty():
			problems.append("no light of the scene is called \"%s\"; it has %s" % [
				row.object, ", ".join(names) if names else "none"])
		for light in found:
			if taken.has(light) and taken[light] != row.lamp:
				problems.append("\"%s\" would get two lamps, \"%s\" and \"%s\": leave one of the lines" % [
					light.name, taken[light], row.lamp])
			taken[light] = row.lamp
			var why := why_not(root, light, lamp_of(row.lamp))
			if why != "":
				problems.append("\"%s\" %s" % [light.name, why])
	return {"problems": problems, "taken": taken}


static func say_before_and_after(light: Light3D, rows: Array, lamp: String) -> void:
	var said: Array[String] = []
	for row in rows:
		if light.get(row[0]) != row[1]:
			said.append("%s %s -> %s" % [row[0], light.get(row[0]), row[1]])
	print("lightcal: %s: %s   (%s)" % [light.name, ", ".join(said) if said else "as it was", lamp])


func _run() -> void:
	var root := get_scene()
	if root == null:
		printerr("lightcal: nothing set: no scene is open; open the one with the lights")
		return
	if not ProjectSettings.get_setting("rendering/lights_and_shadows/use_physical_light_units"):
		printerr("lightcal: nothing set: lumens and lux are ignored without Project Settings > Rendering > ",
			"Lights and Shadows > Use Physical Light Units; turn it on")
		return
	var planned := plan(root)
	for problem in planned.problems:
		printerr("lightcal: nothing set: ", problem)
	if planned.problems:
		return
	var undo := EditorInterface.get_editor_undo_redo()
	undo.create_action("lightcal " + DATA.name)
	for light in planned.taken:
		var rows := figures_for(light, lamp_of(planned.taken[light]))
		say_before_and_after(light, rows, planned.taken[light])
		var what := strays(light, lamp_of(planned.taken[light]))
		if what != "":
			push_warning("lightcal: ", light.name, " ", what)
		for row in rows:
			undo.add_do_property(light, row[0], row[1])
			undo.add_undo_property(light, row[0], light.get(row[0]))
	undo.commit_action()
