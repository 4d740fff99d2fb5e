"""A report as a reader sees it: opened from a file in headless Chromium, the network off.

Usage: report_in_browser.py RUNNER. A pile that goes down and up again is driven into two packings of 200 grains.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

HOSTILE = "</script><script>document.title='no'</script><img src='http://example.org/a.png'>"
STUDY = {
    "study": "loops",
    "question": HOSTILE,
    "base": {
        "bed": {"domain": {"width": "0.8 m", "height": "1.5 m"},
                "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}}},
        "pile": {"radius": "0.05 m", "depth": None, "duration": "3 s",
                 "driving": {"sinusoidal": {"speed": "0.4 m/s", "frequency": "0.5 Hz"}}},
        "fluid": None,
    },
    "record": {"frames": ["0 m"]},
    "replicates": {"seeds": 2},
    "axes": {"pile.tip": ["conical", "flat"]},
    "checks": [{"metric": "tip_resistance_bin_0.10", "value": "10 kPa", "tolerance": "1 MPa", "source": HOSTILE,
                "if": {"pile.tip": "flat"}}],
}
RUNNER = ""


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        place = pathlib.Path(cls.folder.name)
        (place / "loops.json").write_text(json.dumps(STUDY))
        for words in (["loops.json"], ["report", "loops.json", "-o", "r.html"]):
            subprocess.run([RUNNER, *words], cwd=place, check=True, capture_output=True)
        options = webdriver.ChromeOptions()
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                     "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1200,1000"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        cls.browser.execute_cdp_cmd("Network.enable", {})
        cls.browser.execute_cdp_cmd("Network.emulateNetworkConditions",
                                    {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
        cls.address = (place / "r.html").as_uri()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.get_log("browser")
        self.browser.get_log("performance")
        self.browser.get(self.address)

    def ask(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    CHART = "const chart = Chart.getChart(document.querySelector('#results canvas'));"

    def test_has_no_error_and_asks_for_nothing(self):
        self.assertEqual(self.browser.get_log("browser"), [])
        asked = []
        for entry in self.browser.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                asked.append(message["params"]["request"]["url"])
        outside = [url for url in asked if url != self.address and not url.startswith("data:")]
        self.assertEqual(outside, [])
        self.assertIn(self.address, asked)
        self.assertEqual(self.ask("return performance.getEntriesByType('resource').map(e => e.name)"
                                  ".filter(name => !name.startsWith('data:'))"), [])

    def test_shows_hostile_texts_as_texts(self):
        self.assertEqual(self.browser.title, "loops: Seapile report")
        self.assertEqual(self.browser.find_element(By.ID, "question").text, HOSTILE)
        self.assertEqual(self.ask("return [...document.images].filter(i => !i.src.startsWith('data:')).length"), 0)

    def test_draws_depth_downwards_below_an_axis_on_top(self):
        drawn = self.ask(self.CHART + "return {shallow: chart.scales.y.getPixelForValue(0.05), "
                         "deep: chart.scales.y.getPixelForValue(0.2), axis: chart.scales.x.bottom, "
                         "area: chart.chartArea.top}")
        self.assertGreater(drawn["deep"], drawn["shallow"])
        self.assertLessEqual(drawn["axis"], drawn["area"] + 1)

    def test_writes_small_numbers_of_an_axis_in_few_digits(self):
        ticks = [{"value": n * 2e-13} for n in range(-4, 4)]
        self.assertEqual(self.ask("return arguments[0].map((tick, i) => tickText(tick.value, i, arguments[0]))", ticks),
                         ["-8e-13", "-6e-13", "-4e-13", "-2e-13", "0", "2e-13", "4e-13", "6e-13"])

    def test_leaves_no_canvas_and_no_picture_blank(self):
        colours = self.ask("""return [...document.querySelectorAll('canvas')].map(canvas => {
            const bytes = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            const seen = new Set();
            for (let i = 0; i < bytes.length; i += 4) if (bytes[i + 3] > 0) seen.add(bytes.slice(i, i + 3).join());
            return seen.size; })""")
        self.assertEqual(len(colours), 2)
        for found in colours:
            self.assertGreater(found, 10)
        self.assertGreater(self.ask("return document.images[0].naturalWidth"), 0)

    def test_draws_loops_in_the_order_of_the_records(self):
        turns = self.ask(self.CHART + """
            const i = chart.data.datasets.findIndex(d => d.line.kind === 'record');
            chart.setDatasetVisibility(i, true); chart.update();
            const places = chart.getDatasetMeta(i).data.map(e => e.y), depth = chart.data.datasets[i].data.map(p => p.y);
            const right = places.every((y, k) => Math.abs(y - chart.scales.y.getPixelForValue(depth[k])) < 0.5);
            let turns = 0;
            for (let k = 2; k < depth.length; ++k)
              if ((depth[k] - depth[k - 1]) * (depth[k - 1] - depth[k - 2]) < 0) ++turns;
            return {right, turns};""")
        self.assertTrue(turns["right"])
        self.assertGreaterEqual(turns["turns"], 2)

    def test_says_values_with_their_units_at_a_point(self):
        place = self.ask(self.CHART + """
            const i = chart.data.datasets.findIndex(d => d.line.kind === 'mean');
            chart.canvas.scrollIntoView({block: 'center'});
            const e = chart.getDatasetMeta(i).data[1], box = chart.canvas.getBoundingClientRect();
            return [e.x - box.width / 2, e.y - box.height / 2];""")
        canvas = self.browser.find_element(By.CSS_SELECTOR, "#results canvas")
        ActionChains(self.browser).move_to_element_with_offset(canvas, round(place[0]), round(place[1])).perform()
        said = self.ask(self.CHART + "return [...chart.tooltip.title, ...chart.tooltip.body.flatMap(b => b.lines)]")
        self.assertIn("tip conical", said)
        self.assertRegex(" ".join(said), r"Tip resistance q_c: -?[\d.e-]+ k?Pa \(.* to .*\)")
        self.assertIn("Depth d of the tip: 0.075 m", said)

    def test_reaches_every_control_by_tab_and_shows_where_it_is(self):
        controls = self.ask("""window.reached = new Set();
            return document.querySelectorAll('button, a[href], summary').length""")
        for _ in range(controls + 15):
            ActionChains(self.browser).send_keys(Keys.TAB).perform()
            self.ask("reached.add(document.activeElement)")
        missed = self.ask("return [...document.querySelectorAll('button, a[href], summary')]"
                          ".filter(e => !reached.has(e) && e.checkVisibility()).map(e => e.textContent)")
        self.assertGreater(controls, 10)
        self.assertEqual(missed, [])
        self.ask("document.querySelector('#results button').focus({focusVisible: true})")
        self.assertNotEqual(self.ask("return getComputedStyle(document.activeElement).outlineStyle"), "none")

    def pasted(self):
        self.ask("window.area = document.createElement('textarea'); document.body.append(area); area.focus()")
        ActionChains(self.browser).key_down(Keys.CONTROL).send_keys("v").key_up(Keys.CONTROL).perform()
        return self.ask("return area.value")

    def test_copies_tables_and_charts_as_csv_with_and_without_a_clipboard(self):
        data = json.loads(self.ask("return document.getElementById('data').textContent"))
        cost = next(one for one in data["sections"] if one["id"] == "cost")["blocks"][0]
        for without in (False, True):
            if without:
                self.ask("Object.defineProperty(navigator, 'clipboard', {value: undefined})")
            self.browser.find_element(By.CSS_SELECTOR, "#cost button.copy").click()
            self.assertEqual(self.pasted(), cost["csv"])
            self.browser.find_element(By.CSS_SELECTOR, "#results figure button.copy").click()
            rows = self.pasted().splitlines()
            self.assertTrue(rows[0].startswith("case,line,kind,Tip resistance q_c["), rows[0])
            self.assertEqual(len(rows) - 1, self.ask(self.CHART + """return chart.data.datasets
                .filter(d => d.line.kind !== 'tolerance').reduce((n, d) => n + d.data.length, 0)"""))

    def test_has_captions_scopes_and_the_chart_in_numbers(self):
        self.assertEqual(self.ask("return [...document.querySelectorAll('table')].filter(t => !t.caption || "
                                  "!t.querySelector('thead th[scope=col]') || !t.querySelector('tbody th[scope=row]')).length"), 0)
        self.browser.find_element(By.CSS_SELECTOR, "details.values summary").click()
        # The browser tells of the opening, on which the table is filled, in its own time.
        rows = WebDriverWait(self.browser, 10).until(
            lambda _: self.ask("return document.querySelectorAll('details.values tbody tr').length"))
        self.assertGreater(rows, 4)

    def test_prints_whole_charts_and_no_buttons(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        try:
            self.browser.set_window_size(700, 1000)
            found = self.ask("""const box = e => e.getBoundingClientRect();
                return {charts: [...document.querySelectorAll('canvas')].map(e => [box(e).left, box(e).right, box(e).height]),
                        width: document.documentElement.clientWidth,
                        buttons: [...document.querySelectorAll('button.copy')].filter(e => e.checkVisibility()).length}""")
            self.assertEqual(found["buttons"], 0)
            for left, right, height in found["charts"]:
                self.assertGreaterEqual(left, 0)
                self.assertLessEqual(right, found["width"])
                self.assertGreater(height, 100)
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
            self.browser.set_window_size(1200, 1000)


if __name__ == "__main__":
    RUNNER = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
