"""What PedPy says of the recorded people in shared/data: the numbers that tests/outside/pedestrian.rs compares with.

    pip install pedpy
    python pedpy_reference.py ../../../../../shared/data/trajectories/juelich
"""

import pathlib
import sys

import pedpy

data = pathlib.Path(sys.argv[1])


def figures(name, traj, ground, area, line, cut_off):
    area, line = pedpy.MeasurementArea(area), pedpy.MeasurementLine(line)
    step = max(round(0.2 * traj.frame_rate), 1)
    one_sided = pedpy.SpeedCalculation.BORDER_SINGLE_SIDED
    speed = pedpy.compute_individual_speed(traj_data=traj, frame_step=step, speed_calculation=one_sided)
    classic = pedpy.compute_classic_density(traj_data=traj, measurement_area=area)
    area_speed = pedpy.compute_mean_speed_per_frame(traj_data=traj, individual_speed=speed, measurement_area=area)
    cells = pedpy.compute_individual_voronoi_polygons(
        traj_data=traj, walkable_area=ground, cut_off=cut_off and pedpy.Cutoff(radius=cut_off, quad_segments=3)
    )
    density, inside = pedpy.compute_voronoi_density(individual_voronoi_data=cells, measurement_area=area)
    voronoi_speed = pedpy.compute_voronoi_speed(
        traj_data=traj, individual_speed=speed, individual_voronoi_intersection=inside, measurement_area=area
    )
    n_t, crossing = pedpy.compute_n_t(traj_data=traj, measurement_line=line)
    flow = pedpy.compute_flow(
        nt=n_t, crossing_frames=crossing, individual_speed=speed, delta_frame=100, frame_rate=traj.frame_rate
    )
    acceleration = pedpy.compute_individual_acceleration(traj_data=traj, frame_step=step)
    print(name)
    print("  speed", speed.speed.mean(), "acceleration", acceleration.acceleration.mean())
    print("  density", classic.density.mean(), "area_speed", area_speed.speed.mean())
    print("  voronoi_density", density.density.mean(), "voronoi_speed", voronoi_speed.speed.mean())
    for frame in (200, 400, 600):
        row = lambda table, column: float(table[table.frame == frame][column].iloc[0])
        print("  frame", frame, row(density, "density"), row(voronoi_speed, "speed"), row(n_t, "cumulative_pedestrians"))
    print("  crossed", len(crossing), "first", crossing.frame.min(), "last", crossing.frame.max())
    print("  flows", len(flow), "mean", flow.flow.mean())


metre = pedpy.TrajectoryUnit.METER
bottleneck = pedpy.load_trajectory_from_txt(trajectory_file=data / "AO_300_bottleneck.txt", default_unit=metre)
box = pedpy.WalkableArea([(-10, -10), (10, -10), (10, 10), (-10, 10)])
square = [(-1, -2), (1, -2), (1, 0), (-1, 0)]
figures("AO_300_bottleneck.txt, cut off at 0.8 m", bottleneck, box, square, [(-2.5, 0), (2.5, 0)], 0.8)

classroom = pedpy.load_trajectory_from_ped_data_archive_hdf5(trajectory_file=data / "00_01a.h5")
# its walls, thinner: some heads are above those of the file, of which PedPy knows no Voronoi cells
walls = [[(side * x, y) for x, y in [(0.5, -0.2), (2.39, -0.2), (2.39, 0.2), (0.5, 0.2)]] for side in (1, -1)]
ground = pedpy.WalkableArea([(-4, -4), (4, -4), (4, 6), (-4, 6)], walls)
square = [(-1, 0.5), (1, 0.5), (1, 2.5), (-1, 2.5)]
figures("00_01a.h5, on its ground", classroom, ground, square, [(-0.4, 0), (0.4, 0)], None)
