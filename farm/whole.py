"""All of a job: its phases, the merge, and the parts that turn out to be damaged."""

import merge
from job import JobError
from ranges import Range

DAMAGES = 2  # times that damaged parts are rendered again


def rendered_before(parts, job, progress):
    """How many batches are there, whole. Parts that are not are removed."""
    for line in parts.remove_damaged(job.batches):
        progress.say(f"{line}; it is rendered again")
    return sum(part.size for part in parts.names(job.batches))


def make(driver, outputs):
    """Renders what is missing, and joins it into `outputs`. Raises JobError."""
    job, parts = driver.job, driver.parts
    for number, phase in enumerate(job.phases):
        driver.render(phase)
        if number + 1 < len(job.phases):
            # Again at each start: a pilot of other parts would give other bits.
            merged(driver, phase, [parts.pilot], phase.end * job.batch)
    merged(driver, job.batches, outputs, job.samples, finish=job.golden)


def merged(driver, whole, outputs, samples, finish=False):
    """Joins the parts of `whole`. Damaged ones are rendered again first, twice at most."""
    for attempt in range(DAMAGES + 1):
        try:
            names = list(driver.parts.names(whole).values())
            return merge.merge(driver.job, driver.parts.folder, names, outputs, samples, finish)
        except JobError:
            damaged = driver.parts.remove_damaged(whole)
            if not damaged or attempt == DAMAGES:
                raise
            for line in damaged:
                driver.progress.say(f"{line}; it is rendered again")
            again = driver.parts.missing(whole)
            driver.progress.done -= sum(gap.size for gap in again)
            for gap in again:  # a gap at a time: a golden's range must not cross its pilot
                driver.render(Range(*gap))
