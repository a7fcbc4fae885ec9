"""Hydrographs and envelopes as the service tells them, of real runouts of the column on three lattices: against each other, and
against the files that the runouts left."""
import csv
import json
import pathlib
import statistics
import tempfile
import urllib.error
import urllib.request

from phases import check, root
from service import Service

WIDTH = 72.0  # m
STUDY = {"format": "breachline-study/1", "name": "outflow", "scene": str(root / "workflows/scenes/column.json"), "transfer_times": [0.4], "draws": 5,
         "overrides": ["/mpm/cell_size=2", "/mpm/duration=8", '/mpm/sections=[{"name":"toe","x":10},{"name":"far","x":55}]', f"/mpm/breach_width={WIDTH}"]}


def near(a, b, share=1e-6):
    return abs(a - b) <= share * max(abs(a), abs(b), 1e-9)


def table(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def main(folder):
    file = folder / "study.json"
    file.write_text(json.dumps(STUDY))
    service = Service(folder / "data", "--slots", "2")
    try:
        run = service.submit(file)
        service.finish(run)
        variants = [row["variant"] for row in service.rows(run)]

        def text(query):
            url = f"{service.url.rstrip('/')}/v1/runs/{run}/hydrograph?variant={variants[0]}&{query}"
            return urllib.request.urlopen(url, timeout=60).read().decode()

        toe = json.loads(text("section=toe"))
        volume = toe["volume"]["values"]
        check("soil passed the toe", volume[-1] > 10.0, volume[-1])
        check("the widths are the scene's", toe["breach_width"] == [WIDTH] * 3, toe["breach_width"])
        times, flows = toe["time"]["values"], toe["discharge"]["values"]
        summed = sum(flow * (b - a) for flow, a, b in zip(flows[1:], times, times[1:]))
        check("discharge over time is the volume", near(summed, volume[-1], 1e-3), (summed, volume[-1]))
        rows = table(text("section=toe&for=csv"))
        check("the CSV has the same", near(float(rows[-1]["volume_m2"]), volume[-1]) and near(float(rows[-1]["volume_m3"]), WIDTH * volume[-1]), rows[-1])
        flow = [float(row["Flow (m3/s)"]) for row in table(text("section=toe&for=hec-ras&interval=1"))]
        # Straight lines between ordinates one second apart.
        carried = sum(0.5 * (a + b) for a, b in zip(flow, flow[1:]))
        check("HEC-RAS gets what passed", near(carried, WIDTH * volume[-1], 0.01), (carried, WIDTH * volume[-1]))
        url = f"{service.url.rstrip('/')}/v1/runs/{run}/hydrograph?section=toe&percentile="
        volumes = [json.loads(urllib.request.urlopen(f"{service.url.rstrip('/')}/v1/runs/{run}/hydrograph?section=toe&variant={each}").read())
                   ["volume"]["values"][-1] for each in variants]
        median = json.loads(urllib.request.urlopen(url + "50").read())
        check("p50 has the median of the volumes", near(median["volume"]["values"][-1], statistics.median(volumes)), (median["warning"], volumes))
        try:
            urllib.request.urlopen(url + "90")
            check("five runouts have no p90", False)
        except urllib.error.HTTPError as refusal:
            check("five runouts have no p90", "29 are needed" in refusal.read().decode(), refusal.code)
        made = text("section=toe&for=hec-ras-unsteady&rheology=obrien&yield_stress=900&viscosity=20&concentration=0.5")
        lines = made.splitlines()
        at = next(k for k, line in enumerate(lines) if line.startswith("Flow Hydrograph="))
        flow = [float(line[k:k + 8]) for line in lines[at + 1:lines.index("Stage Hydrograph TW Check=0")] for k in range(0, len(line), 8)]
        check("the unsteady flow file says how many flows it has", len(flow) == int(lines[at].split("=")[1]), lines[at])
        check("and carries what passed", near(sum(flow), WIDTH * volume[-1], 0.01), (sum(flow), WIDTH * volume[-1]))
        check("with O'Brien's method, Pa and Pa s", {"Non-Newtonian Method= 2 , ", "User Yeild=   900", "User Viscosity=20"} <= set(lines), made)
        try:
            text("section=toe&for=hec-ras-unsteady&concentration=0.5")
            check("dry sand has no yield stress", False)
        except urllib.error.HTTPError as refusal:
            check("dry sand has no yield stress", "give yield_stress and viscosity" in refusal.read().decode(), refusal.code)
        try:
            text("section=far&for=hec-ras")
            check("nothing that passed is no hydrograph", False)
        except urllib.error.HTTPError as refusal:
            check("nothing that passed is no hydrograph", refusal.code == 422, refusal.code)

        told = service.call(f"/v1/runs/{run}/envelopes")
        check("each lattice is in the envelopes", told["samples"] == 5 and not told["left_out"], told["left_out"])
        service.breach("export", run, folder / "run")
        files = [table(each.read_text()) for each in sorted((folder / "run/tasks").glob("mpm*/envelope.csv"))]
        check("each runout left an envelope", len(files) == 5, len(files))
        bands = {"largest_depth": "largest_depth_m", "largest_velocity": "largest_velocity_m_per_s", "final_depth": "final_depth_m"}
        for name, column in bands.items():
            by_x = {float(rows[0]["x_m"]): statistics.median(float(row[column] or 0.0) for row in rows) for rows in zip(*files)}
            off = [(x, by_x[x], median) for x, median in zip(told["x"], told["bands"][name]["p50"]) if not near(by_x[x], median, 1e-5)]
            check(f"the median of {name} is that of the files at all {len(by_x)} places", len(told["x"]) == len(by_x) and not off, off)

        again = service.submit(file)
        service.finish(again)
        check("the second run computed nothing", all(row["reused"] for row in service.rows(again)), service.rows(again))
        retold = service.call(f"/v1/runs/{again}/envelopes")
        check("reused runouts are in the envelopes", retold["bands"] == told["bands"] and not retold["left_out"], retold["left_out"])
        run = again
        check("and have their hydrographs", json.loads(text("section=toe"))["volume"] == toe["volume"])
    finally:
        service.stop()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
