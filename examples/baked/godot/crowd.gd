## Draws the people of a .glb that `throng run SCENE --figures baked -o run.glb` wrote: one draw call for each body and level of detail.
##
## The poses stay on the graphics processor. For each person a frame needs the number of a pose and the share of the way to the next.
class_name BakedCrowd
extends Node3D

const SHADER := preload("crowd.gdshader")
## Texels in a row of a texture, and rows in a layer; the shader has the same numbers.
const WIDTH := 4096
const HEIGHT := 4096
## Joints that the shader has space for.
const JOINTS := 32
## Texels have singles as numbers of poses.
const POSES := 1 << 24
const PARTS := { "SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4 }
const BYTE := 5121
const SHORT := 5123
const INT := 5125
const SINGLE := 5126
const SIZES := { BYTE: 1, SHORT: 2, INT: 4, SINGLE: 4 }

## The .glb to read at the start.
@export_global_file("*.glb") var file := ""
@export var playing := true
## The moment that is drawn, in seconds after the first.
@export var second := 0.0
## Seconds of the recording in a second.
@export var speed := 1.0
## Distances from the camera up to which each level of detail is drawn, metres.
@export var levels: Array[float] = [8.0, 25.0, 60.0, INF]

## Seconds from the first to the last moment.
var duration := 0.0
## The number of people at the last update.
var there := 0
## Where the node `World` of the .glb stands. The people are placed against it.
var origin := Vector3.ZERO

var _glb: FileAccess
var _json: Dictionary
## Where the numbers of the file begin.
var _start := 0
var _times: PackedFloat64Array
var _hips: PackedFloat32Array
var _people: Array[Person]
var _tallest := 0.0
## The parts of each body: one for each level of detail.
var _bodies: Array[Array]
var _states: ImageTexture


class Person:
	var body: int
	## -1 for people with the colours of their bodies.
	var look: int
	var height: float
	## The first frame, the number of frames, and the first pose of each visit.
	var visits: Array[PackedInt64Array]

	## The number of the pose at a frame and the share of the way to the next pose; -1 while the person is not there.
	func pose(frame: float) -> float:
		for at in range(visits.size() - 1, -1, -1):
			var visit := visits[at]
			if visit[0] <= frame:
				return visit[2] + minf(frame - visit[0], visit[1] - 1) if frame < visit[0] + visit[1] else -1.0
		return -1.0


## A level of detail of a body.
class Part:
	var node := MultiMeshInstance3D.new()
	var material := ShaderMaterial.new()
	## Of each person: the pose, the share of the way to the next, the height, the look.
	var states := PackedFloat32Array()
	## The box round the hips.
	var bounds: AABB


func _ready() -> void:
	if file:
		open(file)


func _process(delta: float) -> void:
	if playing and duration > 0.0:
		second = fposmod(second + delta * speed, duration)
	var camera := get_viewport().get_camera_3d()
	if camera and not _people.is_empty():
		update(second, camera.global_position)


## Reads the people of a .glb.
func open(path: String) -> bool:
	_glb = FileAccess.open(path, FileAccess.READ)
	if _glb == null:
		return _fails(path, "cannot be opened (%s)" % error_string(FileAccess.get_open_error()))
	if _glb.get_length() < 20 or _glb.get_32() != 0x46546c67:
		return _fails(path, "is not a .glb")
	_glb.seek(12)
	var length := _glb.get_32()
	_glb.seek(20)
	var json: Variant = JSON.parse_string(_glb.get_buffer(length).get_string_from_utf8())
	if json is not Dictionary:
		return _fails(path, "is a damaged .glb")
	_json = json
	_start = 28 + length
	var extras: Dictionary = _json.get("asset", {}).get("extras", {})
	if not extras.has("throng.baked"):
		return _fails(path, "has no baked people")
	var baked: Dictionary = extras["throng.baked"]
	var texels := int(_json.bufferViews[int(baked.hips)].byteLength) / 12
	if baked.parents.size() > JOINTS or texels > POSES:
		push_error("%s has more than %d joints or %d poses" % [path, JOINTS, POSES])
		return false
	_read(baked, int(extras["throng.times"]))
	_glb.close()
	return true


## Moves all people to a second. The distance from the eye selects the levels of detail. Returns the number of people.
func update(at: float, eye: Vector3) -> int:
	var frame := _frame(at)
	var near := to_local(eye)
	for body in _bodies:
		for part: Part in body:
			part.states.clear()
	for person in _people:
		var pose := person.pose(frame)
		if pose < 0.0:
			continue
		var place := _place(int(pose))
		var body := _bodies[person.body]
		var level := 0
		while level < mini(body.size(), levels.size()) - 1 and place.distance_to(near) > levels[level]:
			level += 1
		var part: Part = body[level]
		part.bounds = AABB(place, Vector3.ZERO) if part.states.is_empty() else part.bounds.expand(place)
		part.states.push_back(floorf(pose))
		part.states.push_back(pose - floorf(pose))
		part.states.push_back(person.height)
		part.states.push_back(person.look)
	# all people in one texture, part by part
	var states := PackedFloat32Array()
	for body in _bodies:
		for part: Part in body:
			var count := part.states.size() / 4
			part.material.set_shader_parameter("first", states.size() / 4)
			part.node.multimesh.visible_instance_count = count
			part.node.visible = count > 0
			# no part of a body is as far from its hips
			part.node.custom_aabb = part.bounds.grow(1.5 * _tallest)
			states.append_array(part.states)
	there = states.size() / 4
	var size := _states.get_size()
	states.resize(4 * int(size.x * size.y))
	_states.update(Image.create_from_data(int(size.x), int(size.y), false, Image.FORMAT_RGBAF, states.to_byte_array()))
	return there


## The middle of the people at a second, and the distance within which half of them are.
func ball(at: float) -> Dictionary:
	var frame := _frame(at)
	var places := PackedVector3Array()
	var center := Vector3.ZERO
	for person in _people:
		var pose := person.pose(frame)
		if pose >= 0.0:
			places.push_back(_place(int(pose)))
			center += places[-1]
	if places.is_empty():
		return { "center": center, "radius": 5.0 }
	center /= places.size()
	var far := Array(places).map(func(place: Vector3) -> float: return place.distance_to(center))
	far.sort()
	return { "center": center, "radius": far[far.size() / 2] }


## The frame of a second: a whole number and the share of the way to the next.
func _frame(at: float) -> float:
	var time := _times[0] + at
	var low := clampi(_times.bsearch(time, false) - 1, 0, _times.size() - 1)
	if low + 1 == _times.size():
		return low
	return low + clampf((time - _times[low]) / (_times[low + 1] - _times[low]), 0.0, 1.0 - 1e-6)


## The hips of a pose.
func _place(pose: int) -> Vector3:
	return Vector3(_hips[3 * pose], _hips[3 * pose + 1], _hips[3 * pose + 2])


func _fails(path: String, why: String) -> bool:
	push_error("%s %s: write one with `throng run SCENE --figures baked -o run.glb`" % [path, why])
	return false


func _read(baked: Dictionary, times: int) -> void:
	_times = _view(times).to_float64_array()
	duration = _times[-1] - _times[0]
	_hips = _view(int(baked.hips)).to_float32_array()
	for node: Dictionary in _json.nodes:
		if node.get("name") == "World":
			var at: Array = node.get("translation", [0, 0, 0])
			origin = Vector3(at[0], at[1], at[2])
	_people.clear()
	for one: Dictionary in baked.people:
		var person := Person.new()
		person.body = int(one.body)
		person.look = -1 if one.get("look") == null else int(one.look)
		person.height = one.height
		_tallest = maxf(_tallest, person.height)
		for visit: Array in one.visits:
			person.visits.push_back(PackedInt64Array(visit))
		_people.push_back(person)
	# 16-bit numbers, as two texels of four bytes: no format of textures has them in all renderers
	var turns := _texture(int(baked.rotations), Image.FORMAT_RGBA8, 4)
	var hips := _texture(int(baked.hips), Image.FORMAT_RGBF, 12)
	var looks := _looks(baked.looks)
	var rows := ceili(_people.size() / float(WIDTH))
	_states = ImageTexture.create_from_image(Image.create_empty(WIDTH, maxi(rows, 1), false, Image.FORMAT_RGBAF))
	for body in _bodies:
		for part: Part in body:
			part.node.queue_free()
	_bodies.clear()
	for body: Dictionary in baked.bodies:
		var offsets := PackedVector3Array()
		var rests := PackedVector3Array()
		# bodies of files are modelled in a pose of their own
		var figure: Variant = body.get("figure")
		for joint: int in baked.parents.size():
			var offset: Array = body.offsets[joint]
			offsets.push_back(Vector3(offset[0], offset[1], offset[2]))
			var parent := int(baked.parents[joint])
			if figure != null:
				var rest: Array = figure.rests[joint]
				rests.push_back(Vector3(rest[0], rest[1], rest[2]))
			else:
				rests.push_back(offsets[joint] if parent < 0 else rests[parent] + offsets[joint])
		var most := _people.filter(func(person: Person) -> bool: return person.body == _bodies.size()).size()
		var parts := []
		for level: float in body.levels:
			var part := Part.new()
			part.material.shader = SHADER
			part.material.set_shader_parameter("turns", turns)
			part.material.set_shader_parameter("hips", hips)
			part.material.set_shader_parameter("looks", looks)
			part.material.set_shader_parameter("people", _states)
			part.material.set_shader_parameter("joints", baked.parents.size())
			part.material.set_shader_parameter("parents", PackedInt32Array(baked.parents))
			part.material.set_shader_parameter("offsets", offsets)
			part.material.set_shader_parameter("rests", rests)
			part.node.material_override = part.material
			part.node.multimesh = _multimesh(_mesh(int(level)), most)
			add_child(part.node)
			parts.push_back(part)
		_bodies.push_back(parts)


func _multimesh(mesh: Mesh, count: int) -> MultiMesh:
	var made := MultiMesh.new()
	made.transform_format = MultiMesh.TRANSFORM_3D
	made.mesh = mesh
	made.instance_count = count
	# the shader places the people
	for at in count:
		made.set_instance_transform(at, Transform3D.IDENTITY)
	return made


## The colours of the regions by look. A colour below 0 stands for a region that a look does not wear.
func _looks(looks: Array) -> ImageTexture:
	var image := Image.create_empty(maxi(looks[0].size() if looks else 0, 1), maxi(looks.size(), 1), false, Image.FORMAT_RGBAF)
	for look in looks.size():
		for region: int in looks[look].size():
			var rgb: Variant = looks[look][region]
			image.set_pixel(region, look, Color(-1, -1, -1) if rgb == null else Color(rgb[0], rgb[1], rgb[2]))
	return ImageTexture.create_from_image(image)


## A view of the buffer as rows of texels, in as many layers as they need.
func _texture(view: int, format: Image.Format, size: int) -> Texture2DArray:
	var layers: Array[Image] = []
	var length := int(_json.bufferViews[view].byteLength)
	var rows := clampi(ceili(length / float(size * WIDTH)), 1, HEIGHT)
	var most := size * WIDTH * rows
	for from in range(0, maxi(length, 1), most):
		var bytes := _view(view, from, mini(most, length - from))
		bytes.resize(most)
		layers.push_back(Image.create_from_data(WIDTH, rows, false, format, bytes))
	var made := Texture2DArray.new()
	made.create_from_images(layers)
	return made


func _mesh(at: int) -> ArrayMesh:
	var made := ArrayMesh.new()
	var flags := 0
	for shift: int in [Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT, Mesh.ARRAY_FORMAT_CUSTOM1_SHIFT, Mesh.ARRAY_FORMAT_CUSTOM2_SHIFT]:
		flags |= Mesh.ARRAY_CUSTOM_RGBA_FLOAT << shift
	for primitive: Dictionary in _json.meshes[at].primitives:
		var attributes: Dictionary = primitive.attributes
		var arrays := []
		arrays.resize(Mesh.ARRAY_MAX)
		arrays[Mesh.ARRAY_VERTEX] = _vectors(_numbers(int(attributes.POSITION)))
		arrays[Mesh.ARRAY_NORMAL] = _vectors(_numbers(int(attributes.NORMAL)))
		arrays[Mesh.ARRAY_CUSTOM0] = _numbers(int(attributes.JOINTS_0))
		arrays[Mesh.ARRAY_CUSTOM1] = _numbers(int(attributes.WEIGHTS_0))
		arrays[Mesh.ARRAY_CUSTOM2] = _colours(attributes, arrays[Mesh.ARRAY_VERTEX].size())
		# the front of a triangle is clockwise in Godot
		var indices := PackedInt32Array(Array(_numbers(int(primitive.indices))))
		indices.reverse()
		arrays[Mesh.ARRAY_INDEX] = indices
		made.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], {}, flags)
	return made


## Red, green, blue and the region of each vertex; the region is -1 where the mesh has colours.
func _colours(attributes: Dictionary, count: int) -> PackedFloat32Array:
	var made := PackedFloat32Array()
	made.resize(4 * count)
	made.fill(1.0)
	var regions := _numbers(int(attributes._REGION)) if attributes.has("_REGION") else PackedFloat32Array()
	var colours := _numbers(int(attributes.COLOR_0)) if attributes.has("COLOR_0") else PackedFloat32Array()
	var parts := colours.size() / count
	for k in count:
		for part in mini(parts, 3):
			made[4 * k + part] = colours[parts * k + part]
		made[4 * k + 3] = regions[k] if regions else -1.0
	return made


func _vectors(numbers: PackedFloat32Array) -> PackedVector3Array:
	var made := PackedVector3Array()
	for k in range(0, numbers.size(), 3):
		made.push_back(Vector3(numbers[k], numbers[k + 1], numbers[k + 2]))
	return made


## The numbers of an accessor. Normalised ones are parts of 1.
func _numbers(at: int) -> PackedFloat32Array:
	var accessor: Dictionary = _json.accessors[at]
	var kind := int(accessor.componentType)
	var parts: int = PARTS[accessor.type]
	var size: int = SIZES[kind]
	var view := int(accessor.bufferView)
	var bytes := _view(view)
	var stride := int(_json.bufferViews[view].get("byteStride", parts * size))
	var whole := 1.0 if not accessor.get("normalized", false) else 255.0 if kind == BYTE else 65535.0
	var made := PackedFloat32Array()
	for element in int(accessor.count):
		for part in parts:
			var from := int(accessor.get("byteOffset", 0)) + element * stride + part * size
			match kind:
				BYTE: made.push_back(bytes[from] / whole)
				SHORT: made.push_back(bytes.decode_u16(from) / whole)
				INT: made.push_back(bytes.decode_u32(from))
				SINGLE: made.push_back(bytes.decode_float(from))
	return made


## Bytes of a view of the buffer: all, or `length` of them.
func _view(at: int, from := 0, length := -1) -> PackedByteArray:
	var view: Dictionary = _json.bufferViews[at]
	_glb.seek(_start + int(view.get("byteOffset", 0)) + from)
	return _glb.get_buffer(int(view.byteLength) if length < 0 else length)
