## A ground, a sun, and a camera that frames the crowd: drag to turn it, scroll to come nearer.
extends Node3D

const Crowd := preload("crowd.gd")

## Where the camera looks, and from how far.
var target := Vector3.ZERO
var distance := 10.0
var turn := Vector2(-0.25, -0.52)

@onready var crowd: Crowd = $Crowd
@onready var camera: Camera3D = $Camera


func _ready() -> void:
	var arguments := OS.get_cmdline_user_args()
	if crowd.open(arguments[0] if arguments else "res://run.glb"):
		var ball := crowd.ball(0.5 * crowd.duration)
		target = ball.center
		distance = 1.4 * (ball.radius + 3.0)
	_aim()


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and event.button_mask & MOUSE_BUTTON_MASK_LEFT:
		turn -= 0.005 * event.relative
		turn.y = clampf(turn.y, -1.5, 0.0)
	elif event is InputEventMouseButton and event.button_index == MOUSE_BUTTON_WHEEL_UP:
		distance *= 0.9
	elif event is InputEventMouseButton and event.button_index == MOUSE_BUTTON_WHEEL_DOWN:
		distance /= 0.9
	else:
		return
	_aim()


func _aim() -> void:
	camera.position = target + Basis.from_euler(Vector3(turn.y, turn.x, 0.0)) * Vector3(0.0, 0.0, distance)
	camera.look_at(target)
