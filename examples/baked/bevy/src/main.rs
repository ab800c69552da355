//! Plays the people of a `.glb` that `throng run SCENE --figures baked -o run.glb` wrote, or draws one picture.

use baked_crowd::crowd::{BakedCrowd, BakedCrowdPlugin};
use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::input::mouse::{AccumulatedMouseMotion, AccumulatedMouseScroll};
use bevy::light::CascadeShadowConfigBuilder;
use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use std::path::{Path, PathBuf};
use std::time::Duration;

const USAGE: &str = "usage: baked-crowd [run.glb] [--picture OUT.png] [--second S]";
/// Pixels of a picture.
const SIZE: UVec2 = UVec2::new(1280, 720);
/// Updates until all that a picture needs is on the graphics processor.
const UPDATES: u32 = 6;

fn main() -> AppExit {
    match arguments(std::env::args().skip(1)).and_then(app) {
        Ok(mut app) => app.run(),
        Err(error) => {
            eprintln!("error: {error}");
            AppExit::error()
        }
    }
}

struct Arguments {
    file: PathBuf,
    picture: Option<PathBuf>,
    second: Option<f64>,
}

/// What is drawn.
#[derive(Resource)]
struct Show {
    /// The picture, and what the camera draws it into.
    picture: Option<(PathBuf, Handle<Image>)>,
    /// The second that is drawn; none for all of them.
    second: Option<f64>,
}

/// Where the camera is around a point: mouse and wheel move it.
#[derive(Component)]
struct Orbit {
    middle: Vec3,
    far: f32,
    /// Radians.
    turn: f32,
    tilt: f32,
}

fn arguments(mut given: impl Iterator<Item = String>) -> Result<Arguments, String> {
    let (mut file, mut picture, mut second) = (None, None, None);
    while let Some(argument) = given.next() {
        match argument.as_str() {
            "--picture" => picture = Some(given.next().ok_or("--picture needs the name of a .png file")?.into()),
            "--second" => {
                let number = given.next().and_then(|value| value.parse().ok()).filter(|value: &f64| value.is_finite());
                second = Some(number.ok_or("--second needs a number")?);
            }
            name if file.is_none() && !name.starts_with('-') => file = Some(name.into()),
            _ => return Err(format!("unknown argument {argument}; {USAGE}")),
        }
    }
    Ok(Arguments { file: file.unwrap_or_else(|| "run.glb".into()), picture, second })
}

fn app(Arguments { file, picture, second }: Arguments) -> Result<App, String> {
    let mut crowd = BakedCrowd::open(&file)?;
    let scene = std::mem::take(&mut crowd.scene);
    // a picture shows the middle of the time, if no other second is given
    let second = second.or(picture.is_some().then_some(0.5 * crowd.duration()));
    let (middle, most) = crowd.ball(second.unwrap_or(0.5 * crowd.duration()));
    let orbit = Orbit { middle, far: 2.2 * most + 3.0, turn: -0.24, tilt: 0.52 };

    let mut app = App::new();
    let title = format!("{} people of {}", crowd.people(), file.display());
    let render = RenderPlugin { synchronous_pipeline_compilation: picture.is_some(), ..default() };
    let log = LogPlugin { level: Level::WARN, ..default() };
    let plugins = DefaultPlugins.set(log).set(render);
    if picture.is_some() {
        let without = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
        app.add_plugins(plugins.set(without).disable::<WinitPlugin>())
            .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::ZERO));
    } else {
        let window = Window { title, ..default() };
        app.add_plugins(plugins.set(WindowPlugin { primary_window: Some(window), ..default() }));
    }
    let picture = picture.map(|path| {
        let mut images = app.world_mut().resource_mut::<Assets<Image>>();
        (path, images.add(Image::new_target_texture(SIZE.x, SIZE.y, TextureFormat::Rgba8UnormSrgb, None)))
    });

    let mut camera = app.world_mut().spawn((
        Camera3d::default(),
        Projection::from(PerspectiveProjection { fov: 40_f32.to_radians(), far: 2000.0, ..default() }),
        // colours as they are in the file
        Tonemapping::None,
        place(&orbit),
    ));
    if let Some((_, image)) = &picture {
        camera.insert(RenderTarget::Image(image.clone().into()));
    }
    let shadows = CascadeShadowConfigBuilder {
        first_cascade_far_bound: 0.7 * orbit.far,
        maximum_distance: 4.0 * orbit.far,
        ..default()
    };
    camera.insert(orbit);
    app.world_mut().spawn((
        DirectionalLight { illuminance: 2500.0, shadow_maps_enabled: true, ..default() },
        Transform::from_xyz(-3.0, 10.0, 4.0).looking_at(Vec3::ZERO, Vec3::Y),
        shadows.build(),
    ));
    for (mesh, color) in scene {
        let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh);
        let surface = StandardMaterial {
            base_color: color,
            perceptual_roughness: 0.9,
            double_sided: true,
            cull_mode: None,
            ..default()
        };
        let surface = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(surface);
        app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(surface)));
    }
    app.world_mut().spawn(crowd);
    app.add_plugins(BakedCrowdPlugin)
        .insert_resource(ClearColor(Color::srgb_u8(0xdf, 0xe6, 0xee)))
        .insert_resource(GlobalAmbientLight { brightness: 500.0, ..default() })
        .insert_resource(Show { picture, second })
        .add_systems(Update, (play, look, save));
    Ok(app)
}

/// Moves the people on, and begins anew at the end.
fn play(mut crowds: Query<&mut BakedCrowd>, show: Res<Show>, time: Res<Time>) {
    for mut crowd in &mut crowds {
        let duration = crowd.duration().max(1e-3);
        crowd.second = show.second.unwrap_or_else(|| time.elapsed_secs_f64() % duration);
    }
}

fn place(orbit: &Orbit) -> Transform {
    let turn = Quat::from_euler(EulerRot::YXZ, orbit.turn, -orbit.tilt, 0.0);
    Transform::from_translation(orbit.middle + turn * Vec3::Z * orbit.far).with_rotation(turn)
}

/// A drag turns the camera around the middle, the wheel moves it there.
fn look(
    mut cameras: Query<(&mut Orbit, &mut Transform)>,
    buttons: Res<ButtonInput<MouseButton>>,
    motion: Res<AccumulatedMouseMotion>,
    scroll: Res<AccumulatedMouseScroll>,
) {
    for (mut orbit, mut transform) in &mut cameras {
        if buttons.pressed(MouseButton::Left) {
            orbit.turn -= 0.005 * motion.delta.x;
            orbit.tilt = (orbit.tilt + 0.005 * motion.delta.y).clamp(0.02, 1.55);
        }
        orbit.far *= (-0.1 * scroll.delta.y.clamp(-5.0, 5.0)).exp();
        *transform = place(&orbit);
    }
}

/// Saves the picture, if one is to be drawn, and ends the program.
fn save(mut commands: Commands, show: Res<Show>, mut updates: Local<u32>) {
    *updates += 1;
    let Some((path, image)) = show.picture.clone().filter(|_| *updates == UPDATES) else { return };
    commands.spawn(Screenshot::image(image)).observe(
        move |captured: On<ScreenshotCaptured>, mut exits: MessageWriter<AppExit>| {
            let exit = match written(&captured.image, &path) {
                Ok(()) => AppExit::Success,
                Err(error) => {
                    error!("{}: {error}", path.display());
                    AppExit::error()
                }
            };
            exits.write(exit);
        },
    );
}

fn written(image: &Image, path: &Path) -> Result<(), String> {
    let pixels = image.clone().try_into_dynamic().map_err(|error| error.to_string())?;
    pixels.to_rgb8().save(path).map_err(|error| error.to_string())
}
