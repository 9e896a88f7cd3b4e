"""What is run: commands of arris and their peers, by task. Whoever labels points writes the labelled cloud."""

import os
from dataclasses import dataclass, field


@dataclass
class Job:
    task: str
    name: str
    command: list
    peer: bool = True
    threads: int = 1
    most_millions: float = float("inf")  # Takes too long for more.
    environment: dict = field(default_factory=dict)
    copies: list = field(default_factory=list)  # Commands that do the same at the same time.

    @property
    def available(self):
        return all(os.path.exists(part) for part in self.command[:1] + self.command[1:2] if part.startswith("/"))


def jobs_for(cloud, places, settings):
    """@param cloud  has path and spacing. @param places  has bin, work and here."""
    threads = str(settings.threads[0])
    out = os.path.join(places.work, "out.las")

    def arris(task, *options):
        """With every number of threads."""
        verb, *more = options

        def command(count, copy=""):
            return [os.path.join(places.bin, "arris"), verb, cloud.path, *more, "--overwrite", "-q",
                    "-o", os.path.join(places.work, f"out{copy}.las"),
                    "--report", os.path.join(places.work, f"report{copy}.json"),
                    "--memory", settings.memory, "--temp-dir", places.temp, "--threads", str(count)]

        jobs = [Job(task, "arris " + " ".join(options), command(count), False, count) for count in settings.threads]
        if settings.beside:
            jobs[0].copies = [command(settings.threads[0], f"-{copy}") for copy in range(settings.threads[-1])]
        return jobs

    def peer(task, name, program, *arguments, **environment):
        return Job(task, name, [os.path.join(places.bin, program), cloud.path, *arguments],
                   threads=settings.threads[0], environment=environment)

    radius = f"{3.1 * cloud.spacing:.6g}"  # Holds 30 points of a surface.
    open3d = [os.path.join(places.here, "open3d_boundary.py"), cloud.path, radius]
    return [
        *arris("contours", "extract", "--method", "arris"),
        *arris("contours", "extract", "--method", "liu"),
        *arris("contours", "extract", "--method", "zheng"),
        peer("contours", "PCL normals (16) + boundary (30)", "bench_pcl_peer", threads),
        Job("contours", "Open3D normals (16) + boundary (30)", ["/usr/bin/python3", *open3d],
            threads=settings.threads[0], most_millions=5, environment={"OMP_NUM_THREADS": threads}),
        *arris("segments", "segment", "-k", "30"),
        *arris("segments", "segment"),
        peer("segments", "PCL normals (16) + region growing (30)", "bench_pcl_segment", "30", "7.2", "0.2", "20",
             out, "--normal-neighbours", "16", "--threads", threads),
        peer("segments", "CGAL normals (16) + region growing (30)", "bench_cgal_segment", "16", "30", "7.2",
             f"{cloud.spacing:.6g}", "20"),
        *arris("supervoxels", "supervoxel", "--voxel", "0.03", "--seed", "0.4"),
        peer("supervoxels", "PCL supervoxels", "bench_pcl_supervoxel", "0.03", "0.4", out),
    ]
