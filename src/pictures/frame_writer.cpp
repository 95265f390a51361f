#include "pictures/frame_writer.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace hibi {

namespace {

struct Job {
    Image image;
    std::size_t index = 0;
    FrameInfo info;
    PngText text;
    std::filesystem::path poster;
    int uses_left = 0;  // threads that still need the image
};

}  // namespace

struct FrameWriter::Impl {
    std::filesystem::path folder;
    StageTimes* profile = nullptr;
    std::mutex mutex;  // guards everything below
    std::condition_variable changed;
    std::vector<Image> free;  // pictures nobody uses
    std::deque<std::shared_ptr<Job>> to_write, to_encode;
    std::vector<FrameInfo> done;
    bool closed = false;       // no more frames will come
    std::exception_ptr error;  // the first of any thread; all stop then
    double encode_seconds = 0;

    std::vector<std::unique_ptr<Encoder>> encoders;
    bool writes = false;
    std::vector<std::thread> threads;

    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            closed = true;
            if (!finished) to_write.clear(), to_encode.clear();
        }
        changed.notify_all();
        for (std::thread& thread : threads)
            if (thread.joinable()) thread.join();
    }
    bool finished = false;

    void rethrow() const {
        if (error) std::rethrow_exception(error);
    }

    /// Takes jobs off a queue until it is closed and empty, or something failed anywhere.
    template <class Work>
    void work_through(std::deque<std::shared_ptr<Job>>& queue, Work&& work) {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return error || closed || !queue.empty(); });
            if (error || queue.empty()) return;
            const std::shared_ptr<Job> job = queue.front();
            queue.pop_front();
            lock.unlock();
            std::exception_ptr failure;
            try {
                work(*job);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure && !error) error = failure;
            if (--job->uses_left == 0) free.push_back(std::move(job->image));
            changed.notify_all();
        }
    }

    void write(Job& job) {
        {
            const TimedStage timed(profile, "hash");
            job.info.sha256 = pixel_hash(job.image);
        }
        {
            const TimedStage timed(profile, "write PNG");
            write_png(folder / job.info.file, job.image, {.text = job.text});
        }
        if (!job.poster.empty()) write_poster(job);
        const std::lock_guard lock(mutex);
        done[job.index] = job.info;
    }

    void write_poster(const Job& job) const {
        const TimedStage timed(profile, "write poster");
        write_png(job.poster, job.image, {.text = job.text, .small = true});
    }

    void encode(const Job& job) {
        const TimedStage timed(profile, "encode");
        const auto begin = std::chrono::steady_clock::now();
        for (const auto& encoder : encoders) encoder->add(job.image);
        encode_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
};

FrameWriter::FrameWriter(std::filesystem::path folder, int workers, const std::vector<std::string>& formats,
                         const Video& video, StageTimes* profile)
    : impl_(std::make_unique<Impl>()) {
    Impl& impl = *impl_;
    impl.folder = std::move(folder);
    impl.profile = profile;
    impl.writes = workers > 0;
    // One being drawn, one per thread at work, and two waiting for each queue.
    impl.free.assign(workers + 6, Image(video.width, video.height));
    for (const std::string& format : formats)
        impl.encoders.push_back(open_encoder(impl.folder / ("movie." + format), video));
    for (int k = 0; k < workers; ++k)
        impl.threads.emplace_back(
            [&impl] { impl.work_through(impl.to_write, [&](Job& job) { impl.write(job); }); });
    if (!impl.encoders.empty())
        impl.threads.emplace_back(
            [&impl] { impl.work_through(impl.to_encode, [&](Job& job) { impl.encode(job); }); });
}

FrameWriter::~FrameWriter() = default;

Image FrameWriter::take() {
    const TimedStage timed(impl_->profile, "wait for the writers");
    std::unique_lock lock(impl_->mutex);
    impl_->changed.wait(lock, [&] { return impl_->error || !impl_->free.empty(); });
    impl_->rethrow();
    Image image = std::move(impl_->free.back());
    impl_->free.pop_back();
    return image;
}

void FrameWriter::add(Image image, FrameInfo info, PngText text, const std::filesystem::path& poster) {
    const auto job = std::make_shared<Job>();
    job->image = std::move(image);
    job->info = std::move(info);
    job->text = std::move(text);
    job->poster = poster;
    if (!poster.empty() && !impl_->writes) impl_->write_poster(*job);
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->rethrow();
        job->index = impl_->done.size();
        impl_->done.push_back(job->info);
        job->uses_left = (impl_->writes ? 1 : 0) + (impl_->encoders.empty() ? 0 : 1);
        if (impl_->writes) impl_->to_write.push_back(job);
        if (!impl_->encoders.empty()) impl_->to_encode.push_back(job);
        if (job->uses_left == 0) impl_->free.push_back(std::move(job->image));
    }
    impl_->changed.notify_all();
}

std::vector<FrameInfo> FrameWriter::finish() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->closed = impl_->finished = true;
    }
    impl_->changed.notify_all();
    for (std::thread& thread : impl_->threads) thread.join();
    impl_->rethrow();
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& encoder : impl_->encoders) encoder->finish();
    impl_->encode_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return impl_->done;
}

double FrameWriter::encode_seconds() const { return impl_->encode_seconds; }

}  // namespace hibi
