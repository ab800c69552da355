#![allow(clippy::print_stdout)]
#![allow(missing_docs)]
#[path = "../tests/all/paths.rs"] mod paths;
use throng_figure::*;
fn main() {
    let live = std::env::args().nth(1).is_some_and(|a| a == "live");
    println!("{:20} steps mean p95 max cm | skate pen mm air gap dist cm | short mm vang rad/s acc m/s2 zmin zmax bounce", "");
    for (name, samples) in paths::all() {
      for n in 0..1u64 {
        let person = Person::new(5, 11 + n);
        let skeleton = Skeleton::new(&person);
        let (start, end) = (samples[0].time, samples[samples.len() - 1].time);
        let mut poses: Vec<Pose> = Vec::new();
        if live {
            let mut l = Live::new(person, samples[0]).unwrap();
            poses.push(l.pose());
            for s in &samples[1..] { poses.push(l.step(*s).unwrap()); }
        } else {
            let walk = Walk::recorded(&person, &samples).unwrap();
            let mut t = start; while t <= end + 1e-9 { let p = walk.pose(t); let p = match poses.last() { Some(b) => p.near(b), None => p }; poses.push(p); t += 0.04; }
        }
        let mut m = measure::FeetMeasure::new(&person);
        let (mut vang, mut acc) = (0.0f64, 0.0f64);
        let mut who = (0, 0.0);
        for i in 0..poses.len() - 1 {
            for q in 0..4 { let p = poses[i].towards(&poses[i + 1], q as f64 / 4.0); m.push(start + (i as f64 + q as f64 / 4.0) * 0.04, &skeleton.world(&p)); }
            for j in 0..JOINTS { let d = poses[i].rotations[j].dot(poses[i + 1].rotations[j]).abs().min(1.0); let w = 2.0 * d.acos() / 0.04; if w > vang { vang = w; who = (j, start + i as f64 * 0.04); } }
            if i > 0 { let a = (poses[i + 1].hips - 2.0 * poses[i].hips + poses[i - 1].hips).length() / 0.0016; acc = acc.max(a); }
        }
        let zs: Vec<f64> = poses.iter().skip(50).map(|p| p.hips.z / person.height).collect();
        let (lo, hi) = zs.iter().fold((9.0f64, 0.0f64), |(a, b), z| (a.min(*z), b.max(*z)));
        let r = m.report();
        let mut mx = measure::FeetMeasure::new(&person);
        if !live { let walk = Walk::recorded(&person, &samples).unwrap(); let mut t = start; while t < end { mx.push(t, &skeleton.world(&walk.pose(t))); t += 0.01; } }
        let rx = mx.report(); print!("[{:.2} {:.2} pen {:.1}] path {:.2} ", rx.mean_slide*100.0, rx.largest_slide*100.0, rx.penetration*1000., r.mean_path*100.);
        println!("{name:20} {:3} {:.2} {:.2} {:.2} | {:.3} {:.1} {:.3} {:.1} {:.1} | {:.1} ({} {:.2}) {:.1} {:.3} {:.3} {:.1}cm", r.steps, r.mean_slide*100., r.p95_slide*100., r.largest_slide*100., r.skating_ratio, r.penetration*1000., r.airborne, r.least_gap*100., r.least_distance*100., vang, Joint::ALL[who.0].name(), who.1, acc, lo, hi, (hi-lo)*person.height*100.);
      }
    }
}
