//! The worker threads.

use anyhow::Context;

/// Starts as many workers as told, one per processor for 0; their stacks are as large as the main thread's usually is.
pub fn start(jobs: usize) -> anyhow::Result<()> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(jobs).stack_size(8 << 20);
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    let builder = spread::over_processors(builder);
    builder.build_global().context("cannot start the worker threads")
}

/// In virtual machines, Linux takes processors that sleep for ones that the host has taken away, and wakes workers up on
/// processors that are busy: two of them then share one for some milliseconds, time and again, until its load balancing
/// sees to it, which is later than most conversions end. So each worker begins on a processor of its own, and may leave
/// it after a while, by when the processors may have others to serve, too.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod spread {
    use std::sync::{Arc, Mutex, PoisonError};
    use std::time::Duration;

    use rayon::ThreadPoolBuilder;
    use rustix::thread::{CpuSet, Pid, gettid, sched_getaffinity, sched_setaffinity};

    /// How long workers are kept where they began.
    const KEPT: Duration = Duration::from_millis(20);

    pub fn over_processors(builder: ThreadPoolBuilder) -> ThreadPoolBuilder {
        let Some(all) = sched_getaffinity(None).ok().filter(|_| is_virtual()) else { return builder };
        let processors: Vec<usize> = (0..CpuSet::MAX_CPU).filter(|&cpu| all.is_set(cpu)).collect();
        let workers: Arc<Mutex<Vec<Pid>>> = Arc::default();
        builder.start_handler(move |worker| {
            // Fewer than there are processors might all meet others of their kind on the first ones.
            let Some(&processor) =
                processors.get(worker).filter(|_| rayon::current_num_threads() == processors.len())
            else {
                return;
            };
            let mut own = CpuSet::new();
            own.set(processor);
            if sched_setaffinity(None, &own).is_err() {
                return;
            }
            let mut kept = workers.lock().unwrap_or_else(PoisonError::into_inner);
            kept.push(gettid());
            if kept.len() == processors.len() {
                let kept = std::mem::take(&mut *kept);
                std::thread::spawn(move || {
                    std::thread::sleep(KEPT);
                    for worker in kept {
                        let _ = sched_setaffinity(Some(worker), &all); // One that has ended needs no processor.
                    }
                });
            }
        })
    }

    fn is_virtual() -> bool {
        raw_cpuid::CpuId::new().get_feature_info().is_some_and(|features| features.has_hypervisor())
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn workers_may_soon_run_anywhere_again() {
            let all = sched_getaffinity(None).expect("processors");
            let pool = over_processors(ThreadPoolBuilder::new()).build().expect("workers");
            let are_free = || pool.broadcast(|_| sched_getaffinity(None).is_ok_and(|own| own == all));
            while !are_free().into_iter().all(|is_free| is_free) {
                std::thread::sleep(KEPT);
            }
        }
    }
}
